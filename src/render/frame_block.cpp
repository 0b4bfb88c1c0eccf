#include "render/frame_block.h"

#include "render/sphere_sampling.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/frame_block.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// What follows is compiled for each instruction set, for the compiler to make vectors of.
HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

void TurnToViewer(const Vec3Block& normal, const Vec3Block& direction, std::size_t size, Vec3Block& HWY_RESTRICT n) {
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 either = normal[i];
    n.set(i, (dot(either, direction[i]) > 0 ? -1.0 : 1.0) * either);
  }
}

void FindAxes(const Vec3Block& n, std::size_t size, Vec3Block& HWY_RESTRICT s, Vec3Block& HWY_RESTRICT t) {
  for (std::size_t i = 0; i < size; ++i) {
    const Frame frame(n[i]);
    s.set(i, frame.s);
    t.set(i, frame.t);
  }
}

void ToLocal(const Vec3Block& s, const Vec3Block& t, const Vec3Block& n, const Vec3Block& world, std::size_t size,
             Vec3Block& HWY_RESTRICT local) {
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 v = world[i];
    const double scale = 1 / length(v);
    local.x[i] = scale * dot(v, s[i]);
    local.y[i] = scale * dot(v, t[i]);
    local.z[i] = scale * dot(v, n[i]);
  }
}

void ToWorld(const Vec3Block& s, const Vec3Block& t, const Vec3Block& n, const Vec3Block& local, std::size_t size,
             Vec3Block& HWY_RESTRICT world) {
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 v = local[i];
    world.set(i, v.x * s[i] + v.y * t[i] + v.z * n[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(TurnToViewer);
HWY_EXPORT(FindAxes);
HWY_EXPORT(ToLocal);
HWY_EXPORT(ToWorld);

void FrameBlock::find(const Vec3Block& normal, const Vec3Block& direction, std::size_t count, Vec3Block& wo) {
  size_ = whole_vectors(count);
  HWY_DYNAMIC_DISPATCH(TurnToViewer)(normal, direction, size_, n_);
  HWY_DYNAMIC_DISPATCH(FindAxes)(n_, size_, s_, t_);
  to_local(direction, wo);
  for (std::size_t i = 0; i < size_; ++i) wo.set(i, -wo[i]);
}

void FrameBlock::to_local(const Vec3Block& world, Vec3Block& local) const {
  HWY_DYNAMIC_DISPATCH(ToLocal)(s_, t_, n_, world, size_, local);
}

void FrameBlock::to_world(const Vec3Block& local, Vec3Block& world) const {
  HWY_DYNAMIC_DISPATCH(ToWorld)(s_, t_, n_, local, size_, world);
}

}  // namespace tenon
#endif
