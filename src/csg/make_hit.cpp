#include "csg/make_hit.h"

#include "primitive/dispatch.h"

namespace tenon {

Hit make_hit(const CsgTree& tree, const Ray& ray, const Run& run) {
  const Leaf& leaf = tree[run.surface.leaf];
  Hit hit;
  hit.t = run.t;
  hit.bound = run.bound;
  hit.point = ray.at(run.t);
  hit.surface = run.surface;
  hit.is_surface = run.is_surface;
  hit.before = run.before;
  hit.after = run.after;
  hit.entering = run.after != medium_outside;
  hit.faces = run.faces;

  const Vec3 local = leaf.placement.point_to_local(hit.point);
  hit.normal = leaf.placement.normal_to_world(normal(tree.primitives, leaf.primitive, local, run.surface.face));
  hit.material = leaf.material;
  if (run.is_surface) return hit;

  // From one medium into another both sides are solid; the leaf's own sense then says which way is out.
  const bool between_media = run.before != medium_outside && run.after != medium_outside;
  const bool cut = !between_media && run.leaf_entering != hit.entering;
  // Subtracted from and added to zero, so that no component is -0, which JSON would print.
  hit.normal = cut ? Vec3{} - hit.normal : Vec3{} + hit.normal;
  if (!hit.material && run.owner) hit.material = tree[run.owner].material;
  return hit;
}

}  // namespace tenon
