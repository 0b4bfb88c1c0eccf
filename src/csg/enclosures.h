#pragma once

#include <vector>

#include "csg/csg_tree.h"
#include "csg/minimum_enclosure.h"
#include "tenon/math/box3.h"

namespace tenon {

/// A leaf and the box within which it can matter.
struct EnclosedLeaf {
  LeafId leaf;
  Box3 box;
};

/// How far structures grow boxes and cells, so that a leaf is revealed before the ray comes within the error of any of
/// its crossings.
///
/// A crossing's interval covers the points of the ray that lie within the scene's tolerance (2^-42 of the largest
/// coordinate) and the rounding of the ray from the surface. Rounding grows with the distance D of the ray's origin
/// like 2^-49 D, and the structure's own parameters of planes err by 2^-51 D. 2^-32 of the largest coordinate covers
/// twice their sum for origins up to 2^16 times as far away as the scene is large; it costs nothing measurable.
double enclosure_margin(const CsgTree& tree);

/// The bounded leaves that can matter, each with its minimum enclosure (RR-612 §3.1) grown by enclosure_margin(). With
/// `minimum` false, with its whole box.
std::vector<EnclosedLeaf> enclosed_leaves(const CsgTree& tree, bool minimum = true);

/// The hull of the boxes, grown once more, so that a face that lies in the hull has an outside.
Box3 hull_of(const std::vector<EnclosedLeaf>& leaves, double margin);

}  // namespace tenon
