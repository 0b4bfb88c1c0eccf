#include <embree3/rtcore.h>

#include "csg/csg_tree.h"
#include "rays/embree_tracer.h"
#include "rays/judged_places.h"
#include "rays/parts.h"
#include "rays/tenon_tracer.h"

namespace tenon::bench {

namespace {

// Every span and gap along many rays through the bunny's bounds, by either structure within the mesh.
Status check(const std::string& scene_name, const std::string& local, const PartOptions& options, Report& report) {
  constexpr std::size_t rays = 1'000'000;
  const Result<BenchScene> scene = read_scene("scenes/bunny/" + scene_name + ".scad", {{"local", '"' + local + '"'}});
  if (!scene) return scene.error();
  const CsgTree& tree = *scene->scene.tree;
  const Result<std::unique_ptr<Accelerator>> accelerator = build_accelerator(options.accelerator, tree);
  if (!accelerator) return accelerator.error();
  const Result<JudgedPlaces> judged = judge_places(tree, **accelerator, rays);
  if (!judged) return judged.error();
  const std::string name = scene_name + ", " + local;
  report.figure(name, "rays", static_cast<double>(rays), "");
  report.figure(name, "rays that meet the solid", static_cast<double>(judged->met), "");
  report.figure(name, "places judged by winding numbers", static_cast<double>(judged->places), "");
  report.figure(name, "wrong", static_cast<double>(judged->wrong), "");
  if (judged->wrong == 0) return success();
  return Error{ErrorKind::input, name + ": " + std::to_string(judged->wrong) + " places are wrong", {}};
}

TriangleMesh as_embree_takes_it(const tenon::TriangleMesh& mesh) {
  TriangleMesh out;
  for (const Vec3& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) out.vertices.push_back(static_cast<float>(v[axis]));
  }
  for (const auto& corners : mesh.triangles) out.triangles.insert(out.triangles.end(), corners.begin(), corners.end());
  return out;
}

/// Every crossing along the whole ray, on one thread: Tenon's spans, and Embree's hits by a filter that refuses each.
class AllCrossings final : public Tracer {
 public:
  AllCrossings(std::string name, const EmbreeScene* embree, const Accelerator* accelerator)
      : Tracer(std::move(name)), embree_(embree), accelerator_(accelerator) {
    if (accelerator != nullptr) context_ = accelerator->make_context();
  }

  void load(const RaySet& set, int /*threads*/) override {
    set_ = &set;
    crossings = 0;
  }
  void trace(std::size_t begin, std::size_t end, int /*worker*/) override {
    for (std::size_t i = begin; i < end; ++i) {
      const RayQuery& query = set_->rays[i];
      if (accelerator_ != nullptr) {
        spans_.clear();
        accelerator_->all_spans(query, spans_, *context_);
        crossings += 2 * spans_.size();
      } else {
        count_hits(query.ray);
      }
    }
  }
  std::vector<Answer> answers() const override { return {}; }
  Vec3 normal(std::size_t) const override { return {}; }
  void unload() override { set_ = nullptr; }

  std::size_t crossings = 0;

 private:
  struct CountingContext {
    RTCIntersectContext context;
    std::size_t count;
  };
  void count_hits(const Ray& ray) {
    CountingContext counting{};
    rtcInitIntersectContext(&counting.context);
    counting.context.filter = [](const RTCFilterFunctionNArguments* arguments) {
      ++reinterpret_cast<CountingContext*>(arguments->context)->count;
      arguments->valid[0] = 0;
    };
    RTCRayHit hit{};
    hit.ray.org_x = static_cast<float>(ray.origin.x);
    hit.ray.org_y = static_cast<float>(ray.origin.y);
    hit.ray.org_z = static_cast<float>(ray.origin.z);
    hit.ray.dir_x = static_cast<float>(ray.direction.x);
    hit.ray.dir_y = static_cast<float>(ray.direction.y);
    hit.ray.dir_z = static_cast<float>(ray.direction.z);
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree_->handle(), &counting.context, &hit);
    crossings += counting.count;
  }

  const EmbreeScene* embree_;
  const Accelerator* accelerator_;
  std::unique_ptr<TraceContext> context_;
  const RaySet* set_ = nullptr;
  std::vector<SolidSpan> spans_;
};

// The first crossing and all of them, by either structure within the mesh, and by Embree.
Status race(const PartOptions& options, Report& report) {
  const std::string name = "bunny";
  struct Contender {
    BenchScene scene;
    std::unique_ptr<Accelerator> accelerator;
  };
  std::vector<Contender> own;
  for (const char* local : {"bvh", "kd"}) {
    Result<BenchScene> scene = read_scene("scenes/bunny/race.scad", {{"local", '"' + std::string(local) + '"'}});
    if (!scene) return scene.error();
    auto accelerator = build_accelerator(options.accelerator, *scene->scene.tree);
    if (!accelerator) return accelerator.error();
    own.push_back({std::move(*scene), std::move(*accelerator)});
  }
  const CsgTree& tree = *own[0].scene.scene.tree;
  const TriangleMesh mesh =
      as_embree_takes_it(*std::get<SharedMesh>(tree.primitives.values(tree.leaves[0].primitive)[0]));
  const EmbreeScene embree(mesh), filtered(mesh, true);

  const std::vector<RaySet> sets = make_ray_sets(own[0].scene, *own[0].accelerator, 1e-4);
  const auto compete = [&](const std::string& label, const RaySet& set,
                           const std::vector<std::unique_ptr<Tracer>>& tracers) {
    const std::vector<Timing> timings = time_tracers(tracers, set, 1);
    for (const Timing& t : timings) report.rate(name, label, t, set.rays.size(), nullptr);
    report.figure(name, label + ": Tenon's default against Embree", ratio(timings[2], timings[0]), "times as fast");
    report.figure(name, label + ": the kd-tree against the default", ratio(timings[0], timings[1]), "times as fast");
  };
  for (const RaySet& set : sets) {
    std::vector<std::unique_ptr<Tracer>> first;
    first.push_back(std::make_unique<TenonTracer>("tenon bvh", *own[0].accelerator));
    first.push_back(std::make_unique<TenonTracer>("tenon kd", *own[1].accelerator));
    first.push_back(make_embree_tracer("embree 1", embree, 1));
    compete("first of " + std::string(set.name()), set, first);
    if (set.kind == RayKind::shadow) continue;
    std::vector<std::unique_ptr<Tracer>> all;
    all.push_back(std::make_unique<AllCrossings>("tenon bvh", nullptr, own[0].accelerator.get()));
    all.push_back(std::make_unique<AllCrossings>("tenon kd", nullptr, own[1].accelerator.get()));
    all.push_back(std::make_unique<AllCrossings>("embree 1", &filtered, nullptr));
    compete("all of " + std::string(set.name()), set, all);
    for (const auto& tracer : all) {
      report.figure(name, "crossings of " + std::string(set.name()) + " rays, " + tracer->name(),
                    static_cast<double>(static_cast<const AllCrossings&>(*tracer).crossings), "");
    }
  }
  return success();
}

}  // namespace

Status run_bunny(const PartOptions& options, Report& report) {
  report.heading("the Stanford bunny, every span and gap against winding numbers");
  for (const char* name : {"minus_spheres", "minus_shifted", "and_box"}) {
    for (const char* local : {"bvh", "kd"}) {
      if (Status status = check(name, local, options, report); !status) return status;
    }
  }
  report.heading("its rays per second, against Embree");
  return race(options, report);
}

}  // namespace tenon::bench
