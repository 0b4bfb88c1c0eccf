#include "primitive/placement.h"

#include <algorithm>
#include <cmath>

#include "primitive/ray_map-inl.h"
#include "tenon/math/rounding.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {

namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_finite(const Affine3& map) {
  return is_finite(map.row(0)) && is_finite(map.row(1)) && is_finite(map.row(2)) && is_finite(map.translation());
}

// A sum whose rounding errors are kept. Where nothing rounds, the error is zero.
class TrackedSum {
 public:
  void add(double a) {
    const double sum = sum_ + a;
    note(sum_error(sum_, a, sum));
    sum_ = sum;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    note(product_error(a, b, product));
    add(product);
  }
  double value() const { return sum_; }
  /// Bound on what all roundings of value() amount to: at most eight terms, whose sum rounds in turn.
  double error() const { return slips_ * (1 + gamma(8)); }
  /// The sum to twice the precision, but for gamma(8) * error().
  double exact() const { return sum_ + slip_; }

 private:
  void note(double slip) {
    slip_ += slip;
    slips_ += std::fabs(slip);
  }

  double sum_ = 0;
  double slip_ = 0;
  double slips_ = 0;
};

// Euclidean norm of all entries of the linear part, rounded up; at least the norm of the map.
double frobenius_norm(const Affine3& linear) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += dot(linear.row(i), linear.row(i));
  return std::sqrt(sum) * (1 + gamma(12));
}

// How much the linear part stretches a vector at most, rounded up: the root of the largest row sum of L^T L, which
// bounds its largest eigenvalue (Gershgorin). For rotations with uniform scale it is the scale.
double stretch(const Affine3& map) {
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    double sum = 0;
    for (int j = 0; j < 3; ++j) {
      const Vec3 a = map.column(i), b = map.column(j);
      sum += std::fabs(dot(a, b)) + gamma(4) * dot(abs(a), abs(b));
    }
    most = std::max(most, sum);
  }
  return std::sqrt(most) * (1 + gamma(8));
}

// a * v where an exact zero silences an infinite v.
double weigh(double a, double v) {
  return a == 0 ? 0 : a * v;
}

}  // namespace

BoundedAffine3 BoundedAffine3::elementary(const Affine3& map) {
  std::array<int, 3> in_row{}, in_column{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (map.m[i][j] == 0) continue;
      ++in_row[i];
      ++in_column[j];
    }
  }
  BoundedAffine3 result;
  result.map = map;
  const bool axes_to_axes = in_row == std::array{1, 1, 1} && in_column == std::array{1, 1, 1};
  if (axes_to_axes) return result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double largest = max_component(abs(map.row(static_cast<int>(i))));
    for (std::size_t j = 0; j < 3; ++j) {
      const bool exact_zero = map.m[i][j] == 0 && (in_row[i] == 1 || in_column[j] == 1);
      if (!exact_zero) result.error.m[i][j] = 16 * unit_roundoff * largest;
    }
  }
  result.linear_error = frobenius_norm(result.error);
  return result;
}

Vec3 BoundedAffine3::point_error(const Vec3& extent) const {
  Vec3 bound;
  for (int i = 0; i < 3; ++i) {
    const auto& row = error.m[static_cast<std::size_t>(i)];
    for (int j = 0; j < 3; ++j) bound[i] += weigh(row[static_cast<std::size_t>(j)], extent[j]);
    bound[i] = (bound[i] + row[3]) * (1 + gamma(6));
  }
  return bound;
}

// |A B - fl(A B)| <= |A| E_B + E_A |B| + E_A E_B + rounding, entry by entry and in the norm; the smaller of the two
// counts. The rounding is measured, so that exact products stay exact.
BoundedAffine3 operator*(const BoundedAffine3& a, const BoundedAffine3& b) {
  BoundedAffine3 c;
  Affine3 rounding;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      TrackedSum entry;
      double error = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        entry.add_product(a.map.m[i][k], b.map.m[k][j]);
        error +=
            std::fabs(a.map.m[i][k]) * b.error.m[k][j] + a.error.m[i][k] * (std::fabs(b.map.m[k][j]) + b.error.m[k][j]);
      }
      if (j == 3) {
        entry.add(a.map.m[i][3]);
        error += a.error.m[i][3];
      }
      c.map.m[i][j] = entry.value();
      rounding.m[i][j] = entry.error();
      c.error.m[i][j] = (error + entry.error()) * (1 + gamma(12));
    }
  }

  const double a_stretch = stretch(a.map), b_stretch = stretch(b.map), b_translation = length(b.map.translation());
  c.linear_error =
      (a_stretch * b.linear_error + a.linear_error * (b_stretch + b.linear_error) + frobenius_norm(rounding)) *
      (1 + gamma(12));
  c.translation_error = (a_stretch * b.translation_error + a.linear_error * (b_translation + b.translation_error) +
                         a.translation_error + length(rounding.translation())) *
                        (1 + gamma(20));
  for (auto& row : c.error.m) {
    for (std::size_t j = 0; j < 3; ++j) row[j] = std::min(row[j], c.linear_error);
    row[3] = std::min(row[3], c.translation_error);
  }
  return c;
}

// The inverse's error. Let W* = W + δW be the exact map, |δW| <= E, M the computed inverse and M* the exact one. Then
// M* - M = (I - M W*) M*, with |I - M W*| <= Q := |I - M W| + |M| E. Take the local axes in units of the vector x of
// row sums of |M| (so that nothing depends on how the local frame is scaled): when Q x <= x / 2, the series
// M* = M + R M + R² M + ..., R = I - M W*, converges, and since |M| e_j <= x and (I - Q)^-1 x <= 2 x,
//   |M* - M| e_j <= Q |M| e_j + Q² (I - Q)^-1 |M| e_j <= Q |M| e_j + 2 Q (Q x).
std::optional<Placement> Placement::create(const BoundedAffine3& world_from_local, const Vec3& local_center) {
  const Affine3& w = world_from_local.map;
  const Affine3& e = world_from_local.error;
  if (!is_finite(w) || !is_finite(e)) return std::nullopt;
  Affine3 linear = w;
  for (auto& row : linear.m) row[3] = 0;
  const std::optional<Affine3> inverse = linear.inverse();
  if (!inverse) return std::nullopt;
  const Affine3& m = *inverse;

  Matrix3 q{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      TrackedSum residual;
      residual.add(i == j ? -1 : 0);
      double error = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        residual.add_product(m.m[i][k], w.m[k][j]);
        error += std::fabs(m.m[i][k]) * e.m[k][j];
      }
      q[i][j] = (std::fabs(residual.exact()) + gamma(8) * residual.error() + error) * (1 + gamma(12));
    }
  }
  const auto times_q = [&q](std::size_t i, const Vec3& v) { return q[i][0] * v.x + q[i][1] * v.y + q[i][2] * v.z; };
  Vec3 x;
  for (int i = 0; i < 3; ++i) x[i] = dot(abs(m.row(i)), {1, 1, 1});
  Vec3 qx;
  for (int i = 0; i < 3; ++i) {
    qx[i] = times_q(static_cast<std::size_t>(i), x);
    if (!(qx[i] <= x[i] / 2)) return std::nullopt;
  }

  Placement p;
  p.world_from_local_ = w;
  p.map_.world_origin = w.translation();
  for (int i = 0; i < 3; ++i) p.map_.rows[static_cast<std::size_t>(i)] = m.row(i);
  p.map_.world_center = w.point(local_center);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3 row = abs(m.row(i));
    Vec3 error;
    for (int j = 0; j < 3; ++j) error[j] = times_q(k, abs(m.column(j))) + 2 * times_q(k, qx);
    // M v takes three roundings in each sum, v = (o - w) + shift d another two; one more covers products of errors.
    p.map_.relative_error[k] = (error + gamma(6) * row) * (1 + gamma(12));
    p.map_.constant_error[i] = dot(row + error, e.translation()) * (1 + gamma(6));
    p.map_.row_length[i] = length(m.row(i)) * (1 + gamma(6));
  }
  if (!is_finite(p.map_.constant_error) || !is_finite(p.map_.row_length) || !is_finite(p.map_.world_center))
    return std::nullopt;
  return p;
}

Placement::MappedRay Placement::to_local(const Ray& ray, double tolerance, int on_face) const {
  const auto mapped = HWY_NAMESPACE::MapLine(map_, ray.origin, ray.direction, tolerance, on_face >= 0);
  return {{mapped.origin, mapped.direction, mapped.origin_error, mapped.direction_error, on_face}, mapped.shift};
}

// At t of the given ray, s + t' with t' of the mapped one, the exact line lies within
// origin_error + |s + t'| direction_error of it, and the map stretches that by |M| and M's own error.
Placement::MappedRay Placement::to_local(const LocalRay& ray) const {
  MappedRay mapped = to_local(Ray{ray.origin, ray.direction}, 0, ray.on_face);
  const Vec3 direction_error = stretched(ray.direction_error);
  mapped.ray.direction_error += direction_error;
  mapped.ray.origin_error += stretched(ray.origin_error) + std::fabs(mapped.shift) * direction_error;
  return mapped;
}

Vec3 Placement::stretched(const Vec3& error) const {
  Vec3 local = times(map_.relative_error, error);
  for (int i = 0; i < 3; ++i) local[i] += dot(abs(map_.rows[static_cast<std::size_t>(i)]), error);
  return local * (1 + gamma(6));
}

Placement::RayErrors Placement::ray_errors(double farthest, double tolerance, const RayErrors& before) const {
  const Vec3 from{farthest, farthest, farthest};
  // |shift| |d| is at most the distance to the centre.
  const double moved = length(from + abs(map_.world_center)) * (1 + gamma(8));
  RayErrors errors;
  errors.direction = times(map_.relative_error, {1, 1, 1}) + stretched(before.direction);
  errors.origin = map_.constant_error + tolerance * map_.row_length +
                  times(map_.relative_error, from + abs(world_origin())) + stretched(before.origin) +
                  moved * errors.direction;
  return errors;
}

LocalBox Placement::to_local(const Box3& box) const {
  const Vec3 center = box.center() - world_origin();
  const Vec3 half = (box.upper - box.lower) * 0.5;

  LocalBox local;
  local.center = to_local_direction(center);
  Vec3 reach;
  for (int j = 0; j < 3; ++j) {
    Vec3& edge = local.half_edges[static_cast<std::size_t>(j)];
    edge = Vec3{map_.rows[0][j], map_.rows[1][j], map_.rows[2][j]} * half[j];
    reach += abs(edge);
  }
  // center ± half deviates from the box's corner by a rounding of each end, two of the halves and one of the offset.
  const Vec3 slip = unit_roundoff * (2 * (abs(box.lower) + abs(box.upper)) + abs(center) + half);
  const std::array<Vec3, 3> rows{abs(map_.rows[0]), abs(map_.rows[1]), abs(map_.rows[2])};
  // A corner computed from the local centre and half edges takes three more roundings.
  local.error = map_.constant_error + times(map_.relative_error, abs(center) + half) +
                (times(rows, slip) + gamma(4) * (abs(local.center) + reach)) * (1 + gamma(6));
  local.bounds = {local.center - reach - local.error, local.center + reach + local.error};
  return local;
}

}  // namespace tenon
HWY_AFTER_NAMESPACE();
