#include "primitive/bicubic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "primitive/box_clip.h"
#include "primitive/check.h"
#include "primitive/mesh_edges.h"
#include "primitive/patch_basis.h"
#include "primitive/patch_roots.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// A face holds the patch and the place on it: 11 bits, for LocalRay::on_face is signed, and 10 for each of u and v.
constexpr std::size_t most_patches = std::size_t{1} << 11;
constexpr std::uint32_t places = 1024;

std::uint32_t face_of(std::size_t patch, double u, double v) {
  const auto place = [](double x) {
    return static_cast<std::uint32_t>(std::clamp(x * places, 0.0, static_cast<double>(places) - 1));
  };
  return static_cast<std::uint32_t>(patch) << 20 | place(u) << 10 | place(v);
}
std::size_t patch_of(std::uint32_t face) {
  return face >> 20;
}
double u_of(std::uint32_t face) {
  return ((face >> 10 & (places - 1)) + 0.5) / places;
}
double v_of(std::uint32_t face) {
  return ((face & (places - 1)) + 0.5) / places;
}

Box3 box_around(const BezierNet<Vec3>& net) {
  Box3 box;
  for (const Vec3& p : net) box = hull(box, p);
  return box;
}

// The boxes of the parts that a patch is halved into, `levels` times in u and in v.
void add_boxes(const BezierNet<Vec3>& net, int levels, std::vector<Box3>& boxes) {
  if (levels == 0) {
    const Box3 box = box_around(net);
    // Six roundings a level have moved the parts' points.
    boxes.push_back(grown(box, gamma(24) * box.largest_coordinate()));
    return;
  }
  std::array<BezierNet<Vec3>, 2> halves;
  halve(net, true, halves[0], halves[1]);
  for (const BezierNet<Vec3>& half : halves) {
    std::array<BezierNet<Vec3>, 2> quarters;
    halve(half, false, quarters[0], quarters[1]);
    for (const BezierNet<Vec3>& quarter : quarters) add_boxes(quarter, levels - 1, boxes);
  }
}

bool may_meet(const LocalRay& ray, const Box3& box) {
  Chord chord;
  return clip_box(ray, box, 0, chord) && chord.enter.lo <= chord.leave.hi;
}

/// A root, as a crossing of the whole surface.
struct SurfaceRoot : PatchRoot {
  std::size_t patch = 0;
};

// Roots of one sense whose intervals meet are one: found from two sides of an edge, or of a part.
void merge_roots(std::vector<SurfaceRoot>& roots) {
  std::sort(roots.begin(), roots.end(),
            [](const SurfaceRoot& a, const SurfaceRoot& b) { return a.t != b.t ? a.t < b.t : a.patch < b.patch; });
  std::size_t count = 0;
  for (const SurfaceRoot& root : roots) {
    std::size_t same = count;
    for (std::size_t k = count; k-- > 0 && roots[k].hi >= root.lo;) {
      if (roots[k].against == root.against) {
        same = k;
        break;
      }
    }
    if (same == count) {
      roots[count++] = root;
    } else if (roots[same].lo != roots[same].hi) {
      roots[same].lo = std::min(roots[same].lo, root.lo);
      roots[same].hi = std::max(roots[same].hi, root.hi);
    }
  }
  roots.resize(count);
}

// Of two neighbours that face the same way the later one is a copy, or a crossing between them went unseen where the
// line touches the surface; what is left alternates.
void alternate(std::vector<SurfaceRoot>& roots) {
  std::size_t count = 0;
  for (const SurfaceRoot& root : roots) {
    const bool enters = count % 2 == 0;
    if (root.against == enters) roots[count++] = root;
  }
  roots.resize(count - count % 2);
}

}  // namespace

void Bicubic::prepare() {
  problem_ = find_problem();
  if (!problem_.empty()) return;
  auto surface = std::make_shared<Surface>();
  problem_ = split_into_patches(*surface);
  if (!problem_.empty()) return;

  // Whether the patches close a solid shows on polygons; how many does not matter.
  const bool by_polygons = method.name() == "polygons";
  TriangleMesh mesh = polygons(surface->patches, by_polygons ? static_cast<std::size_t>(steps) : 4);
  if (mesh.triangles.empty()) {
    problem_ = "bicubic has no area";
    return;
  }
  if (!hull) {
    if (const auto open = find_open_edges(mesh.triangles)) {
      problem_ = "bicubic makes no solid: its patches leave " + std::to_string(open->count) +
                 " edges of polygons along them open, or turn them both ways; use hull = true";
      return;
    }
    double volume = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const auto [a, b, c] = mesh.corners(i);
      volume += dot(a, cross(b, c));
    }
    surface->sense = volume < 0 ? -1 : 1;
    if (volume < 0) {
      for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
      for (auto& corners : mesh.corner_normals) std::swap(corners[1], corners[2]);
      for (Vec3& n : mesh.normals) n = -n;
    }
  }
  if (by_polygons) {
    surface->mesh.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    surface->mesh.hull = hull;
    surface->mesh.prepare();
    problem_ = surface->mesh.check();
  }
  surface_ = std::move(surface);
}

std::string Bicubic::find_problem() const {
  double largest = 0;
  for (const PointLists& net : points) {
    for (const std::vector<Vec3>& row : net) {
      for (const Vec3& p : row) {
        if (!std::isfinite(p.x + p.y + p.z)) return "a control point of bicubic is not finite";
        largest = std::max(largest, max_component(abs(p)));
      }
    }
  }
  if (points.empty()) return "bicubic without control points shows nothing";
  // Beyond these the polygons' mesh has no bits left.
  if (!(largest >= 1e-30 && largest <= 1e30))
    return "bicubic with coordinates of size " + shortest(largest) + "; scale them to between 1e-30 and 1e30";
  if (!(bias > 0) || !std::isfinite(bias)) return "bicubic with bias = " + shortest(bias) + "; it must be above 0";
  if (!(tension >= 0) || !std::isfinite(tension)) {
    return "bicubic with tension = " + shortest(tension) + "; it must be at least 0";
  }
  if (!(steps >= 1 && steps <= 256 && steps == std::floor(steps))) return "bicubic needs 'steps' from 1 to 256";
  return check_lengths(name, {{"size", size}});
}

std::string Bicubic::split_into_patches(Surface& surface) const {
  const bool is_bezier = basis.name() == "bezier";
  const bool is_beta = basis.name() == "betaspline";
  const BasisMatrix weights = beta_spline(is_beta ? bias : 1, is_beta ? tension : 0);
  const std::size_t stride = is_bezier ? 3 : 1;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PointLists& net = points[k];
    const std::string which = "net " + std::to_string(k) + " of bicubic ";
    const std::size_t rows = net.size(), columns = net.empty() ? 0 : net[0].size();
    for (const auto& row : net) {
      if (row.size() != columns) return which + "has rows of different lengths";
    }
    if (rows < 4 || columns < 4 || (rows - 1) % stride != 0 || (columns - 1) % stride != 0) {
      return which + "has " + std::to_string(rows) + " by " + std::to_string(columns) + " points; " +
             (is_bezier ? "Bézier patches share a row with their neighbours: 4, 7, 10, ... rows and columns"
                        : "splines have at least 4 rows and columns");
    }
    for (std::size_t r = 0; r + 3 < rows; r += stride) {
      for (std::size_t c = 0; c + 3 < columns; c += stride) {
        BezierNet<Vec3> control;
        for (std::size_t i = 0; i < 16; ++i) control[i] = net[r + i / 4][c + i % 4];
        if (!is_bezier) control = blended(control, weights);
        surface.patches.push_back({control, box_around(control)});
        constexpr int levels = 2;
        add_boxes(control, levels, surface.boxes);
      }
    }
    if (surface.patches.size() > most_patches) return "bicubic has more than 2048 patches; use several";
  }
  return {};
}

TriangleMesh Bicubic::polygons(const std::vector<Patch>& patches, std::size_t count) const {
  TriangleMesh mesh;
  const auto before = [](const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::map<Vec3, std::uint32_t, decltype(before)> known(before);
  const std::size_t side = count + 1;
  std::vector<std::uint32_t> grid(side * side);
  for (const Patch& patch : patches) {
    const auto first_normal = static_cast<std::uint32_t>(mesh.normals.size());
    for (std::size_t i = 0; i < side; ++i) {
      for (std::size_t j = 0; j < side; ++j) {
        const double n = static_cast<double>(count);
        const double u = static_cast<double>(i) / n, u_rest = static_cast<double>(count - i) / n;
        const double v = static_cast<double>(j) / n, v_rest = static_cast<double>(count - j) / n;
        const Vec3 p = point_on(patch.net, u, u_rest, v, v_rest);
        const auto [found, is_new] = known.try_emplace(p, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (is_new) mesh.vertices.push_back(p);
        grid[i * side + j] = found->second;
        mesh.normals.push_back(patch_normal(patch.net, u, v));
      }
    }
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (grid[a] == grid[b] || grid[b] == grid[c] || grid[c] == grid[a]) return;
      mesh.triangles.push_back({grid[a], grid[b], grid[c]});
      const auto normal = [first_normal](std::size_t k) { return first_normal + static_cast<std::uint32_t>(k); };
      mesh.corner_normals.push_back({normal(a), normal(b), normal(c)});
    };
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        const std::size_t at = i * side + j;
        add(at, at + side, at + side + 1);
        add(at, at + side + 1, at + 1);
      }
    }
  }
  return mesh;
}

double Bicubic::support(const Vec3& n) const {
  double greatest = -std::numeric_limits<double>::infinity();
  for (const Box3& box : surface_->boxes) greatest = std::max(greatest, box_support(box, n));
  return greatest;
}

// Subdivision ends at parts no larger than `size` along three axes, so the start lies within sqrt(3) times that of the
// surface, and so does a part that is met again: until the ray is twice as far away across the surface, it is the
// start.
double Bicubic::blur_of_start(const LocalRay& ray, std::uint32_t face) const {
  const double across = std::fabs(dot(normalize(normal(ray.origin, face)), ray.direction));
  return 2 * std::sqrt(3) * size / across;
}

void Bicubic::spans(const LocalRay& ray, Spans& out) const {
  if (method.name() == "polygons") return surface_->mesh.spans(ray, out);
  thread_local std::vector<PatchRoot> found;
  thread_local std::vector<SurfaceRoot> roots;
  roots.clear();
  const std::vector<Patch>& patches = surface_->patches;
  LocalRay free = ray;  // its start is no face of a box
  free.on_face = -1;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!may_meet(free, patches[i].box)) continue;
    found.clear();
    find_patch_roots(patches[i].net, ray, static_cast<PatchMethod>(method.index), size, found);
    for (const PatchRoot& root : found) {
      roots.push_back({root, i});
      if (surface_->sense < 0) roots.back().against = !root.against;
    }
  }
  if (ray.on_face >= 0) {
    // The start is a root at exactly 0, in place of those that were found there.
    const auto face = static_cast<std::uint32_t>(ray.on_face);
    const double u = u_of(face), v = v_of(face);
    SurfaceRoot start{{{0, 0, 0}, u, v, dot(normal(ray.origin, face), ray.direction) < 0}, patch_of(face)};
    const double blur = method.name() == "subdivision" ? blur_of_start(ray, face) : 0;
    std::erase_if(roots, [&](const SurfaceRoot& root) {
      return std::fabs(root.t) < blur || (root.against == start.against && root.lo <= 0 && root.hi >= 0);
    });
    roots.push_back(start);
  }
  merge_roots(roots);
  if (!hull) alternate(roots);
  const std::size_t begin = out.size();
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const SurfaceRoot& root = roots[i];
    const double bound = std::max({root.hi - root.t, root.t - root.lo, 0.0}) * (1 + gamma(4));
    out.push_back({root.t, bound, face_of(root.patch, root.u, root.v), !hull && i % 2 == 0, hull});
  }
  put_in_order(begin, out);
}

Region Bicubic::classify(const LocalBox& box) const {
  if (method.name() == "polygons") return surface_->mesh.classify(box);
  for (const Box3& part : surface_->boxes) {
    if (part.overlaps(box.bounds)) return Region::straddles;
  }
  if (hull) return Region::outside;
  // No part comes near the box, so its middle tells, by a line through it of which nothing near is in doubt.
  Spans crossings;
  LocalRay ray;
  ray.origin = box.center;
  ray.direction = {0, 0, 1};
  spans(ray, crossings);
  bool inside = false;
  for (const Crossing& c : crossings) {
    if (!(std::fabs(c.t) > c.bound)) return Region::straddles;
    inside ^= c.t <= 0;
  }
  return inside ? Region::inside : Region::outside;
}

Vec3 Bicubic::normal(const Vec3& point, std::uint32_t face) const {
  if (method.name() == "polygons") return surface_->mesh.normal(point, face);
  const BezierNet<Vec3>& net = surface_->patches[patch_of(face)].net;
  // The nearest place on the patch, by Gauss's and Newton's method from the face's own.
  constexpr int steps_to_nearest = 4;
  double u = u_of(face), v = v_of(face);
  for (int step = 0; step < steps_to_nearest; ++step) {
    const PatchPoint<Vec3> p = evaluate(net, u, v);
    const Vec3 away = point - p.value;
    const double uu = dot(p.by_u, p.by_u), uv = dot(p.by_u, p.by_v), vv = dot(p.by_v, p.by_v);
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 0x1p-40 * uu * vv)) break;
    const double du = dot(p.by_u, away), dv = dot(p.by_v, away);
    u = std::clamp(u + (vv * du - uv * dv) / determinant, 0.0, 1.0);
    v = std::clamp(v + (uu * dv - uv * du) / determinant, 0.0, 1.0);
  }
  return surface_->sense * patch_normal(net, u, v);
}

}  // namespace tenon
