#include "exchange/pov_primitive.h"

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
      {"convex_polyhedron", print_convex_polyhedron}};
  const auto found = printers.find(store.kind(id).name);
  if (found == printers.end()) return false;
  found->second(Fields(store, id), out);
  return true;
}

}  // namespace tenon
