#include "csg/describe_hit.h"

#include "csg/prototype.h"
#include "primitive/dispatch.h"

namespace tenon {

namespace {

// Behind glass that touches an opaque solid it is the opaque solid that is seen.
bool is_behind_glass(MediumId before, MediumId after) {
  return before != medium_outside && after == medium_opaque;
}

}  // namespace

bool shows_owner(const Leaf& leaf, MediumId before, MediumId after) {
  return !leaf.material || leaf.shows_what_it_cut || is_behind_glass(before, after);
}

void describe_hit(const CsgTree& tree, const Ray& ray, bool leaf_entering, LeafId owner, Hit& hit) {
  const Leaf& leaf = tree[hit.surface.leaf];
  hit.point = ray.at(hit.t);
  hit.entering = hit.after != medium_outside;

  const Vec3 local = leaf.placement.point_to_local(hit.point);
  const Vec3 outward = leaf.placement.normal_to_world(normal(tree.primitives, leaf.primitive, local, hit.surface.face));
  hit.material = face_material(tree, hit.surface, hit.point);
  if (hit.is_surface) {
    hit.normal = outward;
    return;
  }

  // Where the ray crosses the leaf and the solid in opposite senses (a cut face, or the far side of one medium that is
  // the near side of the next) the solid's outward normal is the other one. Added to zero, so that no component is -0,
  // which JSON would print.
  const double sense = leaf_entering == hit.entering ? 1 : -1;
  hit.normal = Vec3{} + sense * outward;
  if ((!hit.material || leaf.shows_what_it_cut) && owner) hit.material = owner_material(tree, owner, hit.point);
  if (is_behind_glass(hit.before, hit.after) && owner) hit.material = owner_material(tree, owner, hit.point);
}

}  // namespace tenon
