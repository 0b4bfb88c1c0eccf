#pragma once

#include "render/block.h"

namespace tenon {

/// The frames of a surface's points, z on the viewer's side.
class FrameBlock {
 public:
  /// @param normal     length 1, on either side
  /// @param direction  of the ray that comes from the viewer
  /// @param wo         receives the way back to the viewer, local; z is not above 0 where it runs along the surface
  /// @param count      of points
  void find(const Vec3Block& normal, const Vec3Block& direction, std::size_t count, Vec3Block& wo);

  /// At length 1.
  void to_local(const Vec3Block& world, Vec3Block& local) const;
  void to_world(const Vec3Block& local, Vec3Block& world) const;

 private:
  std::size_t size_ = 0;  // in whole vectors
  Vec3Block s_, t_, n_;
};

}  // namespace tenon
