#include "csg/make_hit.h"

#include "csg/prototype.h"
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
  hit.material = face_material(tree, run.surface, hit.point);
  if (run.is_surface) return hit;

  // Where the ray crosses the leaf and the solid in opposite senses (a cut face, or the far side of one medium that is
  // the near side of the next) the solid's outward normal is the other one. Subtracted from and added to zero, so that
  // no component is -0, which JSON would print.
  const bool opposite = run.leaf_entering != hit.entering;
  hit.normal = opposite ? Vec3{} - hit.normal : Vec3{} + hit.normal;
  if ((!hit.material || leaf.shows_what_it_cut) && run.owner) hit.material = owner_material(tree, run.owner, hit.point);
  // Behind glass that touches an opaque solid it is the opaque solid that is seen.
  const bool between_media = run.before != medium_outside && run.after != medium_outside;
  if (between_media && run.after == medium_opaque && run.owner)
    hit.material = owner_material(tree, run.owner, hit.point);
  return hit;
}

}  // namespace tenon
