#include <array>
#include <charconv>
#include <span>
#include <string_view>

#include "tenon/lang/load.h"

namespace tenon {

namespace {

/// Prints a model as statements of the scene language. Without recursion, for trees are deep.
class CsgPrinter {
 public:
  explicit CsgPrinter(const Model& model) : model_(model) {}

  std::string print() && {
    print_surroundings();
    if (model_.graph.root) print_tree();
    return std::move(out_);
  }

  void print_nodes(FunctionRef<void(std::string_view)> take) && {
    print_surroundings();
    take(out_);
    const std::vector<SceneNode>& nodes = model_.graph.nodes;
    std::vector<bool> is_reached(nodes.size());
    if (model_.graph.root) is_reached[model_.graph.root.get()] = true;
    // Children come before their parents.
    for (std::size_t i = nodes.size(); i-- > 0;) {
      if (!is_reached[i]) continue;
      out_.clear();
      std::vector<Visit> path;
      open(SceneNodeId{i}, 0, path);
      out_ += std::to_string(i);
      for (const SceneNodeId child : nodes[i].children) {
        is_reached[child.get()] = true;
        out_ += ' ' + std::to_string(child.get());
      }
      take(out_);
    }
  }

 private:
  // Deeper lines are indented no further, or a deep tree's text would grow with the square of its depth.
  static constexpr std::size_t deepest_indent = 32;

  struct Visit {
    SceneNodeId node;
    std::size_t next_child;
  };

  void print_tree() {
    std::vector<Visit> path;
    open(model_.graph.root, 0, path);
    while (!path.empty()) {
      Visit& visit = path.back();
      const SceneNode& node = model_.graph[visit.node];
      if (visit.next_child < node.children.size()) {
        open(node.children[visit.next_child++], path.size(), path);
      } else {
        indent(path.size() - 1);
        out_ += "}\n";
        path.pop_back();
      }
    }
  }

  void open(SceneNodeId id, std::size_t depth, std::vector<Visit>& path) {
    const SceneNode& node = model_.graph[id];
    indent(depth);
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) return primitive(leaf->primitive);
    if (const auto* operation = std::get_if<SetOperation>(&node.content)) {
      constexpr std::string_view names[] = {"union", "intersection", "difference", "complement"};
      out_ += names[static_cast<std::size_t>(*operation)];
      out_ += "()";
    } else if (const auto* transform = std::get_if<Transform>(&node.content)) {
      matrix(transform->parent_from_child);
    } else if (const auto* attribute = std::get_if<ColorAttribute>(&node.content)) {
      out_ += "color(";
      color(attribute->color);
      out_ += ')';
    } else if (const auto* of = std::get_if<MaterialAttribute>(&node.content)) {
      material(model_.materials[of->material.get()]);
    } else if (const auto* cut_faces = std::get_if<CutFacesAttribute>(&node.content)) {
      out_ += cut_faces->show == CutFaces::base ? "cut_faces(\"base\")" : "cut_faces(\"tool\")";
    }
    out_ += " {\n";
    path.push_back({id, 0});
  }

  void indent(std::size_t depth) { out_.append(std::min(depth, deepest_indent), '\t'); }

  void primitive(PrimitiveId id) {
    const PrimitiveKind& kind = model_.graph.primitives.kind(id);
    const std::vector<FieldValue> values = model_.graph.primitives.values(id);
    if (const auto* shared = values.empty() ? nullptr : std::get_if<SharedMesh>(&values.front())) return mesh(**shared);
    out_ += kind.scad_name;
    out_ += '(';
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) out_ += ", ";
      out_ += kind.fields[i].name;
      out_ += " = ";
      std::visit(
          [&](const auto& value) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, SharedMesh>) print(value);
          },
          values[i]);
    }
    out_ += ");\n";
  }

  // As it was made, or with its triangles; the scene language wants faces clockwise as seen from outside.
  void mesh(const TriangleMesh& mesh) {
    if (!mesh.source.empty()) {
      out_ += mesh.source + ";\n";
      return;
    }
    out_ += "polyhedron(points = [";
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      if (i > 0) out_ += ", ";
      print(mesh.vertices[i]);
    }
    out_ += "], faces = [";
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (i > 0) out_ += ", ";
      const auto [a, b, c] = mesh.triangles[i];
      out_ += '[' + std::to_string(a) + ", " + std::to_string(c) + ", " + std::to_string(b) + ']';
    }
    out_ += "]);\n";
  }

  void matrix(const Affine3& map) {
    out_ += "multmatrix([";
    for (const auto& row : map.m) {
      numbers(row);
      out_ += ", ";
    }
    out_ += "[0, 0, 0, 1]])";
  }

  void material(const Material& m) {
    out_ += "material(name = ";
    print(m.name);
    constexpr std::string_view models[] = {"whitted", "phong", "lambert", "conductor", "dielectric", "principled"};
    parameter("model", std::string(models[static_cast<std::size_t>(m.model)]));
    const bool course = m.model == MaterialModel::whitted || m.model == MaterialModel::phong;
    const bool lambert = m.model == MaterialModel::lambert;
    if (course) {
      parameter("kd", m.kd);
      parameter("ks", m.ks);
      parameter("kt", m.kt);
      if (m.ka) parameter("ka", *m.ka);
      parameter("shininess", m.shininess);
    } else if (!lambert) {
      parameter("roughness", m.roughness);
    }
    if (m.model == MaterialModel::principled) {
      parameter("metallic", m.metallic);
      parameter("transmission", m.transmission);
      parameter("coat", m.coat);
      parameter("coat_roughness", m.coat_roughness);
    }
    if (!lambert && m.model != MaterialModel::conductor) parameter("ior", m.ior);
    if (m.emission > 0) parameter("emission", m.emission);
    if (m.attenuation_color != Rgba{1, 1, 1, 1}) {
      out_ += ", attenuation_color = ";
      color(m.attenuation_color);
      parameter("attenuation_distance", m.attenuation_distance);
    }
    texture(m.texture);
    if (m.color) {
      out_ += ", color = ";
      color(*m.color);
    }
    parameter("priority", m.priority);
    out_ += ')';
  }

  void texture(const SolidTexture& t) {
    if (t.kind == TextureKind::none) return;
    constexpr std::string_view kinds[] = {"", "checker", "marble", "wood", "noise"};
    parameter("texture", std::string(kinds[static_cast<std::size_t>(t.kind)]));
    out_ += ", texture_color = ";
    color(t.second);
    parameter("texture_size", t.size);
    parameter("turbulence", t.turbulence);
  }

  void light(const Light& light) {
    constexpr std::string_view types[] = {"point", "directional", "spot", "rectangle", "sphere", "environment", "sky"};
    out_ += "light(type = ";
    print(std::string(types[static_cast<std::size_t>(light.kind)]));
    const bool has_place = light.kind == LightKind::point || light.kind == LightKind::spot;
    if (has_place || light.kind == LightKind::rectangle || light.kind == LightKind::sphere) {
      parameter("position", light.position);
    }
    if (light.kind == LightKind::directional || light.kind == LightKind::sky) parameter("direction", light.direction);
    if (light.kind == LightKind::spot) {
      parameter("direction", light.direction);
      parameter("angle", light.angle);
      parameter("softness", light.softness);
    }
    if (has_place) parameter("fade_distance", light.fade_distance);
    if (light.kind == LightKind::sphere) parameter("radius", light.radius);
    if (light.kind == LightKind::rectangle) {
      out_ += ", edges = [";
      print(light.edge_u);
      out_ += ", ";
      print(light.edge_v);
      out_ += ']';
    }
    if (light.kind == LightKind::sky) parameter("turbidity", light.turbidity);
    if (light.kind == LightKind::environment) {
      parameter("turn", light.turn);
      if (!light.file.empty()) parameter("file", light.file);
    }
    out_ += ", color = ";
    color(light.color);
    parameter("intensity", light.intensity);
    out_ += ");\n";
  }

  void print_surroundings() {
    if (const auto& c = model_.camera) {
      out_ += "camera(from = ";
      print(c->from);
      parameter("at", c->at);
      parameter("up", c->up);
      if (c->projection == Projection::perspective) {
        parameter("fov", c->fov);
      } else {
        parameter("orthographic", c->width);
      }
      if (c->aperture > 0) {
        parameter("aperture", c->aperture);
        parameter("focus", c->focus.value_or(length(c->at - c->from)));
      }
      out_ += ");\n";
    }
    for (const SectionCut& cut : model_.section) {
      out_ += "section(planes = [";
      for (std::size_t i = 0; i < cut.planes.size(); ++i) {
        const SectionPlane& plane = cut.planes[i];
        const std::array plane_numbers{plane.normal.x, plane.normal.y, plane.normal.z, plane.d.value_or(0)};
        if (i > 0) out_ += ", ";
        numbers(std::span(plane_numbers).first(plane.d ? 4 : 3));
      }
      out_ += "]);\n";
    }
    for (const Light& l : model_.lights) light(l);
    if (model_.background) color_statement("background", *model_.background);
    if (model_.ambient) color_statement("ambient", *model_.ambient);
  }

  void color_statement(std::string_view name, const Rgba& c) {
    out_ += name;
    out_ += '(';
    color(c);
    out_ += ");\n";
  }

  template <class T>
  void parameter(std::string_view name, const T& value) {
    out_ += ", ";
    out_ += name;
    out_ += " = ";
    print(value);
  }

  void color(const Rgba& c) { numbers(std::array{c.r, c.g, c.b, c.a}); }

  void numbers(std::span<const double> values) {
    out_ += '[';
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) out_ += ", ";
      print(values[i]);
    }
    out_ += ']';
  }

  // The shortest text that reads back to the same double; the sign of a zero means nothing.
  void print(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value + 0.0).ptr;
    out_.append(text.data(), end);
  }
  void print(bool value) { out_ += value ? "true" : "false"; }
  void print(const Vec3& v) { numbers(std::array{v.x, v.y, v.z}); }
  template <class T>
  void print(const std::vector<T>& items) {
    out_ += '[';
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i > 0) out_ += ", ";
      print(items[i]);
    }
    out_ += ']';
  }
  void print(const Plane& p) { numbers(std::array{p.normal.x, p.normal.y, p.normal.z, p.d}); }
  void print(const PolynomialTerm& t) {
    numbers(std::array{static_cast<double>(t.i), static_cast<double>(t.j), static_cast<double>(t.k), t.a});
  }
  void print(const QuadricCoefficients& coefficients) { numbers(coefficients); }
  void print(const Choice& choice) { print(std::string(choice.name())); }
  void print(const Box3& box) {
    if (!box.is_bounded()) {
      out_ += "undef";
      return;
    }
    out_ += '[';
    print(box.lower);
    out_ += ", ";
    print(box.upper);
    out_ += ']';
  }
  void print(const Outline& outline) {
    out_ += '[';
    for (std::size_t i = 0; i < outline.loops.size(); ++i) {
      out_ += i > 0 ? ", [" : "[";
      const auto& loop = outline.loops[i];
      for (std::size_t j = 0; j < loop.size(); ++j) {
        if (j > 0) out_ += ", ";
        const std::array corner{loop[j].x, loop[j].y, loop[j].bulge};
        numbers(std::span(corner).first(loop[j].bulge == 0 ? 2 : 3));
      }
      out_ += ']';
    }
    out_ += ']';
  }
  void print(const std::string& text) {
    out_ += '"';
    for (const char c : text) {
      if (c == '"' || c == '\\') out_ += '\\';
      out_ += c;
    }
    out_ += '"';
  }

  const Model& model_;
  std::string out_;
};

}  // namespace

std::string print_csg(const Model& model) {
  return CsgPrinter(model).print();
}

void print_csg_nodes(const Model& model, FunctionRef<void(std::string_view)> take) {
  CsgPrinter(model).print_nodes(take);
}

}  // namespace tenon
