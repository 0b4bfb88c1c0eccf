#include "exchange/pov_primitive.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

namespace tenon {

namespace {

/// The fields of a primitive by their names.
class Fields {
 public:
  Fields(const PrimitiveStore& store, PrimitiveId id) : kind_(store.kind(id)), values_(store.values(id)) {}

  double number(std::string_view name) const { return get<double>(name); }
  bool flag(std::string_view name) const { return get<bool>(name); }
  template <class T>
  const T& get(std::string_view name) const {
    std::size_t i = 0;
    while (kind_.fields[i].name != name) ++i;
    return std::get<T>(values_[i]);
  }

 private:
  const PrimitiveKind& kind_;
  std::vector<FieldValue> values_;
};

void print_sphere(const Fields& f, PovText& out) {
  out << "sphere { " << Vec3{} << ", " << f.number("r");
}

void print_box(const Fields& f, PovText& out) {
  const Vec3& size = f.get<Vec3>("size");
  const Vec3 lower = f.flag("center") ? size * -0.5 : Vec3{};
  out << "box { " << lower << ", " << lower + size;
}

double lower_end(const Fields& f) {
  return f.flag("center") ? -0.5 * f.number("h") : 0;
}

void print_cylinder(const Fields& f, PovText& out) {
  const double z = lower_end(f);
  out << "cylinder { " << Vec3{0, 0, z} << ", " << Vec3{0, 0, z + f.number("h")} << ", " << f.number("r");
}

void print_cone(const Fields& f, PovText& out) {
  const double z = lower_end(f);
  out << "cone { " << Vec3{0, 0, z} << ", " << f.number("r1") << ", " << Vec3{0, 0, z + f.number("h")} << ", "
      << f.number("r2");
}

// POV-Ray's torus lies around y.
void print_torus(const Fields& f, PovText& out) {
  out << "torus { " << f.number("R") << ", " << f.number("r") << " rotate 90*x";
}

// x² + y² + c z² + g z + j <= 0 within a box.
void print_quadric(double c, double g, double j, const Vec3& lower, const Vec3& upper, PovText& out) {
  out << "intersection { quadric { " << Vec3{1, 1, c} << ", " << Vec3{} << ", " << Vec3{0, 0, g} << ", " << j
      << " } box { " << lower << ", " << upper << " }";
}

void print_hyperboloid(const Fields& f, PovText& out) {
  const double r = f.number("r"), waist = f.number("waist"), half = 0.5 * f.number("h");
  const double slope = (r - waist) * (r + waist) / (half * half);
  print_quadric(-slope, 0, -waist * waist, {-r, -r, -half}, {r, r, half}, out);
}

// The box ends well below the apex: a face that touches it there would be one more surface for rays to meet.
void print_paraboloid(const Fields& f, PovText& out) {
  const double r = f.number("r"), h = f.number("h");
  print_quadric(0, -r * r / h, 0, {-r, -r, -h}, {r, r, h}, out);
}

void print_quadric_in_box(const Fields& f, PovText& out) {
  const auto& q = f.get<QuadricCoefficients>("coefficients");
  const Box3& box = f.get<Box3>("box");
  if (box.is_bounded()) out << "intersection { box { " << box.lower << ", " << box.upper << " } ";
  out << "quadric { " << Vec3{q[0], q[1], q[2]} << ", " << Vec3{q[3], q[4], q[5]} << ", " << Vec3{q[6], q[7], q[8]}
      << ", " << q[9];
  if (box.is_bounded()) out << " }";
}

// POV-Ray wants all coefficients up to the degree, by falling powers of x, then of y, then of z.
void print_algebraic(const Fields& f, PovText& out) {
  const auto& terms = f.get<PolynomialTerms>("terms");
  int degree = 2;
  for (const PolynomialTerm& t : terms) degree = std::max(degree, t.i + t.j + t.k);
  const Box3& box = f.get<Box3>("box");
  out << "intersection { box { " << box.lower << ", " << box.upper << " } poly { " << degree << ", <";
  for (int i = degree; i >= 0; --i) {
    for (int j = degree - i; j >= 0; --j) {
      for (int k = degree - i - j; k >= 0; --k) {
        double a = 0;
        for (const PolynomialTerm& t : terms) a += t.i == i && t.j == j && t.k == k ? t.a : 0;
        out << a << (i + j + k > 0 ? ", " : "> sturm }");
      }
    }
  }
}

// Each loop ends with its first corner again.
void print_polygon(const Fields& f, PovText& out) {
  const auto& loops = f.get<PointLists>("points");
  std::size_t count = 0;
  for (const std::vector<Vec3>& loop : loops) count += loop.size() + 1;
  out << "polygon { " << static_cast<double>(count);
  for (const std::vector<Vec3>& loop : loops) {
    for (const Vec3& p : loop) out << ", " << p;
    out << ", " << loop.front();
  }
}

void print_plane(const Vec3& normal, double d, PovText& out) {
  const double size = length(normal);
  out << "plane { " << normal / size << ", " << d / size;
}

void print_half_space(const Fields& f, PovText& out) {
  print_plane(f.get<Vec3>("normal"), f.number("d"), out);
}

void print_convex_polyhedron(const Fields& f, PovText& out) {
  out << "intersection {";
  for (const Plane& plane : f.get<std::vector<Plane>>("planes")) {
    out << " ";
    print_plane(plane.normal, plane.d, out);
    out << " }";
  }
}

}  // namespace

bool print_pov_primitive(const PrimitiveStore& store, PrimitiveId id, PovText& out) {
  static const std::map<std::string_view, void (*)(const Fields&, PovText&)> printers{
      {"sphere", print_sphere},
      {"cube", print_box},
      {"cylinder", print_cylinder},
      {"cone", print_cone},
      {"torus", print_torus},
      {"hyperboloid", print_hyperboloid},
      {"paraboloid", print_paraboloid},
      {"halfspace", print_half_space},
      {"convex_polyhedron", print_convex_polyhedron},
      {"quadric", print_quadric_in_box},
      {"algebraic", print_algebraic},
      {"polygon3d", print_polygon}};
  const auto found = printers.find(store.kind(id).name);
  if (found == printers.end()) return false;
  const Fields fields(store, id);
  // POV-Ray's polygons are shaded flat.
  if (found->first == "polygon3d" && !fields.get<PointLists>("normals").empty()) return false;
  found->second(fields, out);
  return true;
}

}  // namespace tenon
