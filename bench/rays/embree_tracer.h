#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <vector>

#include "rays/tracer.h"

namespace tenon::bench {

/// A triangle mesh, as Embree takes it.
struct TriangleMesh {
  std::vector<float> vertices;      ///< three a vertex
  std::vector<unsigned> triangles;  ///< three a triangle

  std::size_t size() const { return triangles.size() / 3; }
};

/// A ball without anything cut from it.
struct Ball {
  Vec3 center;
  double radius = 1;
};

/// The scene's spheres without what is cut from them; none if it is made of much else.
std::vector<Ball> bare_balls(const Scene& scene);

/// Embree's tree over a mesh or over balls, built at RTC_BUILD_QUALITY_HIGH with RTC_SCENE_FLAG_ROBUST (rays miss no
/// shared edge).
class EmbreeScene {
 public:
  /// @param filters  whether queries may bring a filter of their own, which takes a little time
  explicit EmbreeScene(const TriangleMesh& mesh, bool filters = false);
  explicit EmbreeScene(const std::vector<Ball>& balls);
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  ~EmbreeScene();

  RTCScene handle() const { return scene_; }
  /// CPU seconds of all threads that the build took.
  double build_seconds() const { return build_seconds_; }

 private:
  void build(RTCGeometry geometry, bool filters);

  RTCDevice device_;
  RTCScene scene_;
  double build_seconds_ = 0;
};

/// rtcIntersect1 and rtcOccluded1 (width 1), or the calls for packets of 8 and 16.
std::unique_ptr<Tracer> make_embree_tracer(std::string name, const EmbreeScene& scene, int width);

}  // namespace tenon::bench
