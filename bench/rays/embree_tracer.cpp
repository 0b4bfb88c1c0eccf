#include "rays/embree_tracer.h"

#include <algorithm>

#include "csg/csg_tree.h"
#include "rays/measure.h"

namespace tenon::bench {

namespace {

float as_float(double v) {
  return static_cast<float>(v);
}

/// The calls and types of one width, by the same names. A ray is lane k of packet i.
template <int Width>
struct Calls;
template <>
struct Calls<8> {
  using RayHit = RTCRayHit8;
  static void intersect(const int* valid, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcIntersect8(valid, s, c, r);
  }
  static void occluded(const int* valid, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcOccluded8(valid, s, c, &r->ray);
  }
};
template <>
struct Calls<16> {
  using RayHit = RTCRayHit16;
  static void intersect(const int* valid, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcIntersect16(valid, s, c, r);
  }
  static void occluded(const int* valid, RTCScene s, RTCIntersectContext* c, RayHit* r) {
    rtcOccluded16(valid, s, c, &r->ray);
  }
};

// An occluded ray has its end set to minus infinity.
bool is_hit(bool shadow, float t_far, unsigned geometry) {
  return shadow ? t_far < 0 : geometry != RTC_INVALID_GEOMETRY_ID;
}

class SingleTracer final : public Tracer {
 public:
  SingleTracer(std::string name, const EmbreeScene& scene) : Tracer(std::move(name)), scene_(scene) {}

  void load(const RaySet& set, int) override {
    shadow_ = set.kind == RayKind::shadow;
    rays_.resize(set.rays.size());
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const RayQuery& q = set.rays[i];
      RTCRay& r = rays_[i].ray;
      r.org_x = as_float(q.ray.origin.x), r.org_y = as_float(q.ray.origin.y), r.org_z = as_float(q.ray.origin.z);
      r.dir_x = as_float(q.ray.direction.x), r.dir_y = as_float(q.ray.direction.y);
      r.dir_z = as_float(q.ray.direction.z);
      r.tnear = 0, r.tfar = as_float(q.t_max), r.time = 0;
      r.mask = ~0U, r.id = 0, r.flags = 0;
      rays_[i].hit.geomID = rays_[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
  }
  void trace(std::size_t begin, std::size_t end, int) override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (shadow_) {
      for (std::size_t i = begin; i < end; ++i) rtcOccluded1(scene_.handle(), &context, &rays_[i].ray);
    } else {
      for (std::size_t i = begin; i < end; ++i) rtcIntersect1(scene_.handle(), &context, &rays_[i]);
    }
  }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    all.reserve(rays_.size());
    for (const RTCRayHit& r : rays_) {
      all.push_back({is_hit(shadow_, r.ray.tfar, r.hit.geomID), static_cast<double>(r.ray.tfar)});
    }
    return all;
  }
  Vec3 normal(std::size_t ray) const override {
    const RTCHit& hit = rays_[ray].hit;
    return normalize(Vec3{hit.Ng_x, hit.Ng_y, hit.Ng_z});
  }
  void unload() override { rays_ = {}; }

 private:
  const EmbreeScene& scene_;
  bool shadow_ = false;
  std::vector<RTCRayHit> rays_;
};

template <int Width>
class PacketTracer final : public Tracer {
 public:
  PacketTracer(std::string name, const EmbreeScene& scene) : Tracer(std::move(name)), scene_(scene) {}

  void load(const RaySet& set, int) override {
    shadow_ = set.kind == RayKind::shadow;
    coherent_ = set.kind != RayKind::diffuse;
    count_ = set.rays.size();
    packets_.resize((count_ + Width - 1) / Width);
    for (std::size_t i = 0; i < packets_.size() * Width; ++i) {
      const RayQuery& q = set.rays[std::min(i, count_ - 1)];
      auto& packet = packets_[i / Width];
      const std::size_t k = i % Width;
      auto& r = packet.ray;
      r.org_x[k] = as_float(q.ray.origin.x), r.org_y[k] = as_float(q.ray.origin.y);
      r.org_z[k] = as_float(q.ray.origin.z);
      r.dir_x[k] = as_float(q.ray.direction.x), r.dir_y[k] = as_float(q.ray.direction.y);
      r.dir_z[k] = as_float(q.ray.direction.z);
      r.tnear[k] = 0, r.tfar[k] = as_float(q.t_max), r.time[k] = 0;
      r.mask[k] = ~0U, r.id[k] = 0, r.flags[k] = 0;
      packet.hit.geomID[k] = packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
  }
  void trace(std::size_t begin, std::size_t end, int) override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherent_ ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (std::size_t i = begin; i < end; i += Width) {
      alignas(64) int valid[Width];
      for (int k = 0; k < Width; ++k) valid[k] = i + static_cast<std::size_t>(k) < end ? -1 : 0;
      auto* packet = &packets_[i / Width];
      if (shadow_) {
        Calls<Width>::occluded(valid, scene_.handle(), &context, packet);
      } else {
        Calls<Width>::intersect(valid, scene_.handle(), &context, packet);
      }
    }
  }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    all.reserve(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      const auto& p = packets_[i / Width];
      const std::size_t k = i % Width;
      all.push_back({is_hit(shadow_, p.ray.tfar[k], p.hit.geomID[k]), static_cast<double>(p.ray.tfar[k])});
    }
    return all;
  }
  Vec3 normal(std::size_t ray) const override {
    const auto& hit = packets_[ray / Width].hit;
    const std::size_t k = ray % Width;
    return normalize(Vec3{hit.Ng_x[k], hit.Ng_y[k], hit.Ng_z[k]});
  }
  void unload() override { packets_ = {}; }

 private:
  const EmbreeScene& scene_;
  bool shadow_ = false, coherent_ = true;
  std::size_t count_ = 0;
  std::vector<typename Calls<Width>::RayHit> packets_;
};

}  // namespace

std::vector<Ball> bare_balls(const Scene& scene) {
  const CsgTree& tree = *scene.tree;
  std::vector<Ball> balls;
  for (const Leaf& leaf : tree.leaves) {
    if (tree.primitives.kind(leaf.primitive).name != "sphere") continue;
    const Vec3 half = 0.5 * leaf.bounds.size();
    balls.push_back({leaf.bounds.center(), max_component(half)});
  }
  constexpr double most = 0.9;
  if (static_cast<double>(balls.size()) < most * static_cast<double>(tree.leaves.size())) balls.clear();
  return balls;
}

EmbreeScene::EmbreeScene(const TriangleMesh& mesh, bool filters)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), mesh.vertices.size() / 3));
  std::copy(mesh.vertices.begin(), mesh.vertices.end(), vertices);
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.size()));
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), indices);
  build(geometry, filters);
}

EmbreeScene::EmbreeScene(const std::vector<Ball>& balls)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), balls.size()));
  for (const Ball& ball : balls) {
    for (const double v : {ball.center.x, ball.center.y, ball.center.z, ball.radius}) *vertices++ = as_float(v);
  }
  build(geometry, false);
}

void EmbreeScene::build(RTCGeometry geometry, bool filters) {
  build_seconds_ = cpu_seconds([&] {
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    const RTCSceneFlags filter = filters ? RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION : RTC_SCENE_FLAG_NONE;
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST | filter);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  });
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

std::unique_ptr<Tracer> make_embree_tracer(std::string name, const EmbreeScene& scene, int width) {
  if (width == 8) return std::make_unique<PacketTracer<8>>(std::move(name), scene);
  if (width == 16) return std::make_unique<PacketTracer<16>>(std::move(name), scene);
  return std::make_unique<SingleTracer>(std::move(name), scene);
}

}  // namespace tenon::bench
