#include "accel/cells/leaf_records.h"

#include <cmath>
#include <limits>
#include <optional>

#include "accel/cells/certainty.h"
#include "accel/cells/planes_recorder.h"
#include "primitive/dispatch.h"
#include "primitive/lists.h"
#include "tenon/math/rounding.h"

namespace tenon::cells {

namespace {

double square(double x) {
  return x * x;
}

// A solid of revolution in its own frame: x² + y² <= alpha + beta z + gamma z² between two caps.
struct Profile {
  double low, high;
  double alpha, beta, gamma;
  double greatest_radius;

  // The same with z measured from between the caps.
  Profile around_middle() const {
    const double m = 0.5 * (low + high), half = 0.5 * (high - low);
    return {-half, half, alpha + m * (beta + m * gamma), beta + 2 * m * gamma, gamma, greatest_radius};
  }
};

Profile profile_of(const Cylinder& c) {
  return {c.low(), c.high(), c.r * c.r, 0, 0, c.r};
}
Profile profile_of(const Cone& c) {
  const double low = c.center ? -0.5 * c.h : 0, slope = (c.r2 - c.r1) / c.h, offset = c.r1 - slope * low;
  return {low, low + c.h, offset * offset, 2 * offset * slope, slope * slope, std::max(c.r1, c.r2)};
}
Profile profile_of(const Hyperboloid& p) {
  const double waist = p.waist * p.waist;
  return {-0.5 * p.h, 0.5 * p.h, waist, 0, (p.r * p.r - waist) / square(0.5 * p.h), p.r};
}
Profile profile_of(const Paraboloid& p) {
  return {0, p.h, 0, p.r * p.r / p.h, 0, p.r};
}

bool sends_axes_to_axes(const Affine3& map) {
  return map.row(0).y == 0 && map.row(0).z == 0 && map.row(1).x == 0 && map.row(1).z == 0 && map.row(2).x == 0 &&
         map.row(2).y == 0;
}

// The scale of a map that keeps angles, as well as doubles can tell.
std::optional<double> similarity_scale(const Affine3& map) {
  const double scale = length(map.row(0)), slip = gamma(16) * square(scale);
  for (int i = 0; i < 3; ++i) {
    const double expected[3] = {i == 0 ? square(scale) : 0, i == 1 ? square(scale) : 0, i == 2 ? square(scale) : 0};
    for (int j = 0; j < 3; ++j) {
      if (std::fabs(dot(map.row(i), map.row(j)) - expected[j]) > slip) return std::nullopt;
    }
  }
  return scale;
}

// The scale across z of a map that keeps the z axis and angles across it.
std::optional<double> scale_around_z(const Affine3& map) {
  const Vec3 x = map.row(0), y = map.row(1), z = map.row(2);
  if (x.z != 0 || y.z != 0 || z.x != 0 || z.y != 0) return std::nullopt;
  const double scale = length(x), slip = gamma(16) * square(scale);
  if (std::fabs(dot(x, y)) > slip || std::fabs(dot(y, y) - square(scale)) > slip) return std::nullopt;
  return scale;
}

class Recorder {
 public:
  Recorder(const CsgTree& tree, const CellScale& scale, const Vec3& center, LeafRecords& records)
      : tree_(tree), scale_(scale), center_(center), records_(records) {}

  RecordRef record(const Leaf& leaf) {
    if (leaf.prototype) return {RecordKind::instance, leaf.prototype.get()};
    if (has_next_crossing(tree_.primitives, leaf.primitive)) return {RecordKind::mesh, 0};
    return visit(tree_.primitives.lists(), leaf.primitive, [&](const auto& primitive) {
      if constexpr (requires { add(leaf, primitive); }) {
        return add(leaf, primitive);
      } else {
        return RecordRef(RecordKind::general, 0);
      }
    });
  }

 private:
  static constexpr double most_slope = PlanesRecorder::most_slope;

  RecordRef add(const Leaf& leaf, const Sphere& sphere) {
    const Certainty certainty(leaf, scale_);
    const double e = length(certainty.place());
    const double error = e * (2 * sphere.r + e) + gamma(12) * sphere.r * sphere.r;
    if (!(e < sphere.r / 16) || !certainty.starts_are_certain(sphere.r, square(certainty.least_stretch())))
      return {RecordKind::general, 0};
    const Placement& p = leaf.placement;
    const Affine3& map = p.local_from_world_linear();
    const double graze = certainty.graze(error), radius_square = square(sphere.r);
    if (const std::optional<double> scale = similarity_scale(map)) {
      const double world_square = radius_square / square(*scale);
      std::vector<double> values(BallRecord::size);
      put(values, BallRecord::center, p.world_origin() - center_);
      values[BallRecord::square] = world_square;
      values[BallRecord::graze] = least_half_chord(graze / square(square(*scale)), world_square);
      return append(RecordKind::ball, values);
    }
    // An ellipsoid: a solid of revolution whose caps touch it at its poles would be grazed there, so they stand off.
    const double r = sphere.r;
    return add_frustum(leaf, certainty, {-2 * r, 2 * r, r * r, 0, -1, r}, graze);
  }

  // Half a chord, squared, that a ray has to have: it does not graze, its ends are further apart than four resolutions,
  // and what the arithmetic here rounds (2^-48 of the reach, by 1 / slope) is far below the resolution.
  double least_half_chord(double graze, double radius_square) const {
    return std::max({graze, square(4 * scale_.resolution), 0x1p-40 * radius_square});
  }

  RecordRef add(const Leaf& leaf, const Box& box) {
    const Certainty certainty(leaf, scale_);
    const Placement& p = leaf.placement;
    const Affine3& map = p.local_from_world_linear();
    Vec3 least;
    for (int i = 0; i < 3; ++i) least[i] = certainty.least_slope(certainty.place()[i]);
    if (sends_axes_to_axes(map)) {
      Vec3 a, b;
      for (int i = 0; i < 3; ++i) {
        const double scale = map.row(i)[i];
        a[i] = p.world_origin()[i] + box.lower()[i] / scale;
        b[i] = p.world_origin()[i] + box.upper()[i] / scale;
        if (!note_slope(least[i] / std::fabs(scale))) return {RecordKind::general, 0};
      }
      std::vector<double> values(AlignedBoxRecord::size);
      put(values, AlignedBoxRecord::low, min(a, b) - center_);
      put(values, AlignedBoxRecord::high, max(a, b) - center_);
      return append(RecordKind::aligned_box, values);
    }
    std::vector<double> values(BoxRecord::size);
    const Vec3 middle = 0.5 * (box.lower() + box.upper());
    put(values, BoxRecord::center, p.world_from_local().point(middle) - center_);
    for (int i = 0; i < 3; ++i) {
      const double unit = 2 / box.size[i];
      if (!(least[i] <= most_slope * length(map.row(i)))) return {RecordKind::general, 0};
      put(values, BoxRecord::map + static_cast<std::size_t>(3 * i), unit * map.row(i));
      values[BoxRecord::least + static_cast<std::size_t>(i)] = unit * least[i];
    }
    return append(RecordKind::box, values);
  }

  RecordRef add(const Leaf& leaf, const Cylinder& cylinder) {
    const Certainty certainty(leaf, scale_);
    const double r = cylinder.r, e = std::hypot(certainty.place().x, certainty.place().y);
    if (!(e < r / 0x1p10)) return {RecordKind::general, 0};
    return add_revolved(leaf, certainty, profile_of(cylinder), certainty.graze(e * (2 * r + e) + gamma(12) * r * r));
  }
  RecordRef add(const Leaf& leaf, const Cone& cone) {
    return add_revolved_quadric(leaf, cone.quadric(), profile_of(cone));
  }
  RecordRef add(const Leaf& leaf, const Hyperboloid& p) {
    return add_revolved_quadric(leaf, p.quadric(), profile_of(p));
  }
  RecordRef add(const Leaf& leaf, const Paraboloid& p) {
    return add_revolved_quadric(leaf, p.quadric(), profile_of(p));
  }

  // A line this steep moves aside by at most r / 8 along three heights: along one that its part between the caps has,
  // and two that its nearest point may lie off. Its component along the axis is then at least 3/4 of its length.
  static double parallel_share(double r, double h, const Certainty& certainty) {
    return square(std::min(r / (8 * 4 * h), 0.5) * certainty.least_stretch());
  }

  RecordRef add_revolved_quadric(const Leaf& leaf, const RevolvedQuadric& quadric, const Profile& profile) {
    const Certainty certainty(leaf, scale_);
    const std::optional<double> graze = certainty.graze_of(quadric);
    if (!graze) return {RecordKind::general, 0};
    return add_revolved(leaf, certainty, profile, *graze);
  }

  RecordRef add_revolved(const Leaf& leaf, const Certainty& certainty, const Profile& profile, double graze) {
    const Placement& p = leaf.placement;
    const Affine3& map = p.local_from_world_linear();
    const std::optional<double> across = scale_around_z(map);
    if (!across) return add_frustum(leaf, certainty, profile, graze);
    const double along = map.row(2).z, s2 = square(*across);
    if (!note_slope(certainty.least_slope(certainty.place().z) / std::fabs(along))) return {RecordKind::general, 0};
    const Profile middle = profile.around_middle();
    const double half = middle.high / std::fabs(along);
    std::vector<double> values(UprightRecord::size);
    put(values, UprightRecord::center, middle_of(p, profile) - center_);
    put_profile(values, UprightRecord::profile,
                {-half, half, middle.alpha / s2, middle.beta * along / s2, middle.gamma * along * along / s2, 0},
                graze / square(s2), parallel_of(profile, certainty) / s2, start_of(profile, certainty) / s2,
                square(profile.greatest_radius) / s2);
    return append(RecordKind::upright, values);
  }

  RecordRef add_frustum(const Leaf& leaf, const Certainty& certainty, const Profile& profile, double graze) {
    const Placement& p = leaf.placement;
    const Affine3& map = p.local_from_world_linear();
    const double least = certainty.least_slope(certainty.place().z);
    if (!(least <= most_slope * length(map.row(2)))) return {RecordKind::general, 0};
    std::vector<double> values(FrustumRecord::size);
    for (int i = 0; i < 3; ++i) put(values, FrustumRecord::map + static_cast<std::size_t>(3 * i), map.row(i));
    put(values, FrustumRecord::center, middle_of(p, profile) - center_);
    values[FrustumRecord::least] = least;
    put_profile(values, FrustumRecord::profile, profile.around_middle(), graze, parallel_of(profile, certainty),
                start_of(profile, certainty), square(profile.greatest_radius));
    return append(RecordKind::frustum, values);
  }

  static Vec3 middle_of(const Placement& p, const Profile& profile) {
    return p.world_from_local().point({0, 0, 0.5 * (profile.low + profile.high)});
  }

  // Only along a cylinder a line may run beside the side for as long as it likes.
  static double parallel_of(const Profile& profile, const Certainty& certainty) {
    const bool is_cylinder = profile.beta == 0 && profile.gamma == 0;
    return is_cylinder ? parallel_share(profile.greatest_radius, profile.high - profile.low, certainty) : 0;
  }

  // An ellipsoid is known to be met again steeply enough, a cylinder by those who go across it.
  static double start_of(const Profile& profile, const Certainty& certainty) {
    if (profile.gamma < 0) return 0;
    if (profile.gamma == 0 && profile.beta == 0) return certainty.least_certain_start(profile.greatest_radius);
    const double linear = profile.gamma == 0 ? profile.beta : 0;
    return certainty.least_certain_quadratic(profile.greatest_radius, std::sqrt(profile.gamma), linear);
  }

  static void put_profile(std::vector<double>& values, std::size_t at, const Profile& p, double graze, double parallel,
                          double start, double radius_square) {
    values[at + ProfileRecord::low] = p.low;
    values[at + ProfileRecord::high] = p.high;
    values[at + ProfileRecord::alpha] = p.alpha;
    values[at + ProfileRecord::beta] = p.beta;
    values[at + ProfileRecord::gamma] = p.gamma;
    values[at + ProfileRecord::graze] = graze;
    values[at + ProfileRecord::parallel] = parallel;
    values[at + ProfileRecord::start] = start;
    values[at + ProfileRecord::inside] = square(0.75) * radius_square;
    values[at + ProfileRecord::outside] = square(1.25) * radius_square;
  }

  // As TorusQuartic has it: a place that is off by e moves f by e (2 r + e) (1 + (r + e) / R); and w, of size R before
  // it cancels, rounds sixteen times at most, f is at most 2 r times as much off.
  RecordRef add(const Leaf& leaf, const Torus& torus) {
    const Certainty certainty(leaf, scale_);
    const double R = torus.R, r = torus.r, e = length(certainty.place());
    if (!(e < r / 0x1p10)) return {RecordKind::general, 0};
    const double error = e * (2 * r + e) * (1 + (r + e) / R) + gamma(64) * (R + r) * r;
    const Placement& p = leaf.placement;
    std::vector<double> values(TorusRecord::size);
    for (int i = 0; i < 3; ++i) {
      put(values, TorusRecord::map + static_cast<std::size_t>(3 * i), p.local_from_world_linear().row(i));
    }
    put(values, TorusRecord::center, p.world_origin() - center_);
    values[TorusRecord::major] = R;
    values[TorusRecord::minor] = r;
    values[TorusRecord::error] = 2 * error;
    values[TorusRecord::least] = certainty.least_slope(2 * error);
    return append(RecordKind::torus, values);
  }

  RecordRef add(const Leaf& leaf, const ConvexPolyhedron& solid) {
    PlanesRecorder planes(leaf, scale_, center_);
    for (const Plane& plane : solid.planes) planes.add(plane, gamma(8) * std::fabs(plane.d));
    if (!(planes.least_slope() <= most_slope)) return {RecordKind::general, 0};
    return append(RecordKind::convex, planes.values());
  }

  static void put(std::vector<double>& values, std::size_t at, const Vec3& v) {
    for (int i = 0; i < 3; ++i) values[at + static_cast<std::size_t>(i)] = v[i];
  }

  // The least slope of leaves along the axes is one for all. @return whether it is small enough
  bool note_slope(double least) {
    if (!(least <= most_slope)) return false;
    records_.least_slope = std::max(records_.least_slope, least);
    return true;
  }

  RecordRef append(RecordKind kind, const std::vector<double>& values) {
    return {kind, append_values(values, records_.lines)};
  }

  const CsgTree& tree_;
  const CellScale& scale_;
  const Vec3& center_;
  LeafRecords& records_;
};

// Caps and straight walls are flat, and met once.
// @param direction  in the leaf's frame. @param square  of its length in the world
bool outline_start_is_certain(const double* r, int on_face, const Vec3& direction, double square) {
  if (on_face < static_cast<int>(Prism::walls)) return true;
  const int edge = (on_face - static_cast<int>(Prism::walls)) / 2;
  const auto count = static_cast<std::size_t>(r[WallsRecord::count]);
  for (std::size_t i = 0; i < count; ++i) {
    const double* wall = r + OutlineRecord::walls + i * OutlineRecord::wall_size;
    if (wall[OutlineRecord::index] != edge) continue;
    const double curvature = wall[WallsRecord::Wall::curvature];
    if (curvature == 0) return true;
    const double change = r[OutlineRecord::scale_slope] * direction.z;
    const double x = direction.x - change * wall[OutlineRecord::from];
    const double y = direction.y - change * wall[OutlineRecord::from + 1];
    const double* normal = wall + WallsRecord::Wall::normal;
    const double a = curvature * (x * x + y * y) + change * (normal[0] * x + normal[1] * y);
    return std::fabs(a) > wall[OutlineRecord::start] * square;
  }
  return false;
}

}  // namespace

bool LeafRecords::start_is_certain(RecordRef ref, int on_face, const Vec3& direction) const {
  const double* r = values(ref);
  const auto mapped = [&](std::size_t first_row, std::size_t i) {
    const double* const row = r + first_row + 3 * i;
    return dot(Vec3{row[0], row[1], row[2]}, direction);
  };
  if (ref.kind() == RecordKind::outline) {
    const auto row = [&](std::size_t i) { return mapped(OutlineRecord::map, i); };
    return outline_start_is_certain(r, on_face, {row(0), row(1), row(2)}, dot(direction, direction));
  }
  // The caps are flat.
  if (on_face != 0) return true;
  const auto is_certain = [&](const double* profile, double x, double y, double z) {
    const double a = square(x) + square(y) - profile[ProfileRecord::gamma] * square(z);
    return std::fabs(a) > profile[ProfileRecord::start] * dot(direction, direction);
  };
  if (ref.kind() == RecordKind::upright) {
    return is_certain(r + UprightRecord::profile, direction.x, direction.y, direction.z);
  }
  if (ref.kind() == RecordKind::frustum) {
    const auto row = [&](std::size_t i) { return mapped(FrustumRecord::map, i); };
    return is_certain(r + FrustumRecord::profile, row(0), row(1), row(2));
  }
  return true;
}

std::size_t LeafRecords::append(const std::vector<Line>& pieces) {
  const std::size_t first = lines.size();
  lines.insert(lines.end(), pieces.begin(), pieces.end());
  return first;
}

LeafRecords LeafRecords::of(const CsgTree& tree, const CellScale& scale, const Vec3& center,
                            std::span<const LeafId> order) {
  LeafRecords records;
  records.of_leaf.resize(tree.leaves.size());
  Recorder recorder(tree, scale, center, records);
  for (const LeafId leaf : order) records.of_leaf[leaf.get()] = recorder.record(tree[leaf]);
  // The first line is asked for where a leaf has no record, but not read.
  if (records.lines.empty()) records.lines.emplace_back();
  return records;
}

}  // namespace tenon::cells
