#include "csg/make_hit.h"

#include "csg/describe_hit.h"

namespace tenon {

Hit make_hit(const CsgTree& tree, const Ray& ray, const Run& run) {
  Hit hit;
  hit.t = run.t;
  hit.bound = run.bound;
  hit.surface = run.surface;
  hit.is_surface = run.is_surface;
  hit.before = run.before;
  hit.after = run.after;
  hit.faces = run.faces;
  describe_hit(tree, ray, run.leaf_entering, run.owner, hit);
  return hit;
}

}  // namespace tenon
