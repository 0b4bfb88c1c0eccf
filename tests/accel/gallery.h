#pragma once

#include <ostream>

#include "accel/random_solids.h"
#include "support/meshes.h"

/// The scenes that every structure is tried on.
namespace tenon::gallery {

using fixtures::Draw;
using fixtures::SceneBuilder;

struct Scene {
  const char* name;
  CsgTree (*build)();

  friend void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }
};

inline std::vector<SceneNodeId> random_parts(Draw& draw, SceneBuilder& b, int count, double spread,
                                             bool may_be_unbounded = true) {
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < count; ++i) {
    parts.push_back(random_place(draw, b, spread, random_primitive(draw, b, may_be_unbounded)));
  }
  return parts;
}

inline CsgTree random_scene(std::uint64_t seed, int count, double spread) {
  Draw draw(seed);
  SceneBuilder b;
  return b.tree(random_tree(draw, b, random_parts(draw, b, count, spread)));
}

/// Boxes and cylinders whose faces lie in integer planes, so that most of them coincide with others.
inline SceneNodeId lattice_node(SceneBuilder& b, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<SceneNodeId> parts;
  const auto cell = [&] { return static_cast<double>(draw.below(4)); };
  for (int i = 0; i < 30; ++i) {
    const Vec3 lower{cell(), cell(), cell()};
    const Vec3 size{1.0 + draw.below(2), 1.0 + draw.below(2), 1.0 + draw.below(2)};
    parts.push_back(b.translate(lower, draw.one_in(4) ? b.cylinder(size.z, 0.5 * size.x) : b.cube(size)));
  }
  return random_tree(draw, b, parts);
}

inline CsgTree nested_scene() {
  SceneBuilder b;
  SceneNodeId inner = b.sphere(0.1);
  for (int i = 2; i < 20; ++i) {
    const double r = 0.1 * i;
    inner = b.subtract({i % 2 == 0 ? b.cube({2 * r, 2 * r, 2 * r}, true) : b.sphere(1.7 * r), inner});
  }
  return b.tree(inner);
}

inline CsgTree deep_scene() {
  Draw draw(11);
  SceneBuilder b;
  SceneNodeId node = b.sphere(1);
  for (int i = 0; i < 150; ++i) {
    const SceneNodeId next = random_place(draw, b, 1.5, random_primitive(draw, b, false));
    const int op = draw.below(12);
    node = op < 7    ? b.unite({node, next})
           : op < 11 ? b.subtract({node, next})
                     : b.intersect({node, b.complement(next)});
  }
  return b.tree(node);
}

inline CsgTree flat_scene() {
  Draw draw(12);
  SceneBuilder b;
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 30; ++i) {
    const Vec3 thin{draw.real(0.5, 2), draw.real(0.5, 2), draw.one_in(2) ? 1e-6 : 1e-9};
    const SceneNodeId part = draw.one_in(2) ? b.cube(thin) : b.transform(Affine3::scale(thin), b.sphere(1));
    parts.push_back(b.translate(draw.vector(-1, 1), draw.one_in(2) ? b.rotate(draw.vector(0, 90), part) : part));
  }
  return b.tree(random_tree(draw, b, parts));
}

inline CsgTree sized_scene(std::uint64_t seed, double scale, const Vec3& offset) {
  Draw draw(seed);
  SceneBuilder b;
  const SceneNodeId node = random_tree(draw, b, random_parts(draw, b, 16, 1.5, false));
  return b.tree(b.translate(offset, b.scale(scale, node)));
}

/// Small solids in a large space: many cells, most of them empty.
inline CsgTree swarm_scene() {
  Draw draw(14);
  SceneBuilder b;
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 300; ++i) {
    const SceneNodeId part = b.scale(draw.real(0.05, 0.6), random_primitive(draw, b, false));
    parts.push_back(b.translate(draw.vector(-6, 6), b.rotate(draw.vector(0, 360), part)));
  }
  for (std::size_t i = 0; i < parts.size(); i += 10) parts[i] = b.subtract({parts[i], parts[i + 1]});
  return b.tree(b.unite(parts));
}

/// Sizes of all orders of magnitude, in one another.
inline CsgTree scales_scene() {
  Draw draw(115);
  SceneBuilder b;
  std::vector<SceneNodeId> parts;
  for (double s = 1e-5; s < 1e3; s *= 3) {
    parts.push_back(b.translate(draw.direction() * (2 * s), b.scale(s, random_primitive(draw, b, false))));
  }
  return b.tree(random_tree(draw, b, parts));
}

inline CsgTree same_place_scene() {
  Draw draw(16);
  SceneBuilder b;
  const SceneNodeId cube = b.cube({1, 1, 1}, true), ball = b.sphere(0.6);
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 60; ++i) parts.push_back(i % 3 == 0 ? ball : cube);
  return b.tree(b.subtract({b.unite(parts), b.unite({ball, b.sphere(0.55)})}));
}

/// Glass in glass: overlapping transparent media with priorities, and opaque parts.
inline CsgTree media_scene(std::uint64_t seed, bool lattice) {
  CsgTree tree = [&] {
    SceneBuilder b;
    if (lattice) return b.tree(lattice_node(b, seed));
    return random_scene(seed, 14, 1.2);
  }();
  Draw draw(seed + 1);
  tree.has_media = true;
  for (Leaf& leaf : tree.leaves) {
    leaf.medium = static_cast<MediumId>(1 + draw.below(4));
    leaf.priority = draw.below(2);
    leaf.material = MaterialId{leaf.medium};
  }
  return tree;
}

/// Bodies less tools that are cut themselves: what a tool leaves is the body's, of whichever medium the tools are.
inline CsgTree media_tools_scene() {
  Draw draw(23);
  SceneBuilder b;
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 8; ++i) {
    const std::vector<SceneNodeId> p = random_parts(draw, b, 3, 0.6, false);
    const SceneNodeId tool = b.subtract({p[1], p[2]});
    const SceneNodeId part = i % 2 == 0 ? b.subtract({p[0], tool}) : b.intersect({p[0], b.complement(tool)});
    parts.push_back(b.translate(draw.vector(-1, 1), part));
  }
  CsgTree tree = b.tree(b.unite(parts));
  tree.has_media = true;
  for (Leaf& leaf : tree.leaves) {
    leaf.medium = static_cast<MediumId>(1 + draw.below(4));
    leaf.priority = draw.below(2);
    if (!draw.one_in(3)) leaf.material = MaterialId{leaf.medium};
  }
  return tree;
}

/// Solids that occur often and are stored once: apart, through one another, cut by one another, mirrored, and, in one
/// another, twice over.
inline SceneNodeId repeated_node(SceneBuilder& b, std::uint64_t seed) {
  Draw draw(seed);
  const SceneNodeId part = random_subtree(draw, b, random_parts(draw, b, 6, 0.8, false));
  const SceneNodeId plate = b.subtract({b.cube({2, 2, 1}), b.translate({1, 1, 0}, b.cylinder(1, 0.5)),
                                        b.color({1, 0, 0, 1}, b.translate({0, 0, 0.5}, b.cube({1, 1, 0.5}))),
                                        b.translate({2, 2, 1}, b.sphere(0.6))});
  const SceneNodeId stack = b.unite({plate, b.translate({0, 0, 1}, plate), b.translate({2, 0, 0}, plate), part,
                                     b.translate({1, 1, 2}, b.scale(0.5, part))});
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 6; ++i) parts.push_back(random_place(draw, b, 4, part));
  for (int i = 0; i < 3; ++i) parts.push_back(b.translate({4.0 * i, 0, 0}, stack));
  parts.push_back(b.subtract({b.cube({8, 3, 1.5}), b.rotate({0, 0, 30}, plate), b.translate({4, 1, 1}, part)}));
  return b.unite(parts);
}

inline CsgTree repeated_scene() {
  SceneBuilder b;
  return b.instanced_tree(repeated_node(b, 21));
}

/// Prisms of outlines with holes and arcs, cut by prisms and cylinders whose caps and walls lie in theirs.
inline CsgTree outlines_scene() {
  SceneBuilder b;
  const Outline slot{{{{-1, -0.5, 0}, {1, -0.5, 1}, {1, 0.5, 0}, {-1, 0.5, 1}}}};
  const Outline frame{{{{-2, -1, 0}, {2, -1, 0}, {2, 1, 0.5}, {-2, 1, 0}}, {{-1, -0.5, 0}, {1, -0.5, 0}, {0, 0.5, 0}}}};
  Outline gear{{{}}};
  for (int i = 0; i < 40; ++i) {
    const double r = i % 4 < 2 ? 1 : 1.25;
    gear.loops[0].push_back({r * cos_degrees(9 * i), r * sin_degrees(9 * i), 0});
  }
  const auto prism = [&](const Outline& outline, double h, double scale) {
    return b.primitive("prism", {outline, h, false, scale});
  };
  const SceneNodeId plate = b.subtract({prism(frame, 1, 1), prism(slot, 1, 1), b.cylinder(1, 0.5)});
  const SceneNodeId wheel =
      b.subtract({prism(gear, 0.5, 1), b.cylinder(0.5, 0.25), b.translate({0, 0, 0.25}, prism(slot, 0.25, 1))});
  // A turned outline, cut by the torus and the cylinder that its own arc and segment make.
  const SceneNodeId vase = b.subtract(
      {b.primitive("revolution", {Outline{{{{0, 0, 0}, {1, 0, 0}, {1, 0.5, -0.5}, {0.75, 1.5, 0}, {0, 1.5, 0}}}}}),
       b.translate({0, 0, 0.5}, b.torus(1, 0.25)), b.cylinder(1.5, 0.75)});
  return b.tree(b.unite({plate, b.translate({0, -2.5, 0}, vase), b.translate({0, 0, 1}, prism(slot, 1, 0.5)),
                         b.translate({0, 2.5, 0}, b.rotate({30, 0, 0}, wheel))}));
}

/// Solids of polynomials, patches that close one, and surfaces, cutting one another and cut by the simple ones.
inline CsgTree surfaces_scene() {
  SceneBuilder b;
  const auto with = [&](std::string_view name, const std::vector<std::pair<std::size_t, FieldValue>>& given) {
    const PrimitiveKind& kind = *PrimitiveStore::find_kind(name);
    std::vector<FieldValue> values;
    for (const FieldInfo& field : kind.fields) values.push_back(field.fallback);
    for (const auto& [i, value] : given) values[i] = value;
    return b.primitive(name, values);
  };
  const auto choice = [](std::string_view name, std::size_t field, std::uint8_t index) {
    Choice c = std::get<Choice>(PrimitiveStore::find_kind(name)->fields[field].fallback);
    c.index = index;
    return c;
  };
  // A torus, a surface with a double point, and their like by the other methods.
  const PolynomialTerms torus{{4, 0, 0, 1}, {0, 4, 0, 1},    {0, 0, 4, 1},    {2, 2, 0, 2},    {2, 0, 2, 2},
                              {0, 2, 2, 2}, {2, 0, 0, -1.5}, {0, 2, 0, -1.5}, {0, 0, 2, 0.75}, {0, 0, 0, 0.25}};
  const PolynomialTerms cayley{{2, 0, 0, 4}, {0, 2, 0, 4}, {0, 0, 2, 4}, {1, 1, 1, 16}, {0, 0, 0, -1}};
  const Box3 around{{-1.3, -1.3, -1.3}, {1.3, 1.3, 1.3}};
  const SceneNodeId ring = with("algebraic", {{0, torus}, {1, around}});
  const SceneNodeId nodes = with("algebraic", {{0, cayley}, {1, around}, {2, choice("algebraic", 2, 1)}});
  const SceneNodeId saddle = with("quadric", {{0, QuadricCoefficients{1, -1, 0, 0, 0, 0, 0, 0, -1, 0}}, {1, around}});
  const SceneNodeId beyond = with("quadric", {{0, QuadricCoefficients{1, 1, -0.25, 0, 0, 0, 0, 0, 0, -0.04}}});
  const SceneNodeId chisel = with("truncated_cone", {{0, 1.0}, {1, 0.8}, {2, 0.4}, {3, 0.1}, {4, 0.9}});
  const SceneNodeId sheet = with("bicubic", {});
  PointLists net;
  for (std::size_t i = 0; i < 8; ++i) {
    auto& row = net.emplace_back();
    for (std::size_t j = 0; j < 7; ++j) {
      const double angle = 72.0 * static_cast<double>(i % 5), tilt = 90.0 * static_cast<double>(j % 4);
      const double r = 1 + 0.6 * cos_degrees(tilt);
      row.push_back({r * cos_degrees(angle), r * sin_degrees(angle), 0.6 * sin_degrees(tilt)});
    }
  }
  const SceneNodeId patches =
      with("bicubic", {{0, ControlNets{net}}, {1, choice("bicubic", 1, 1)}, {7, FieldValue(false)}});
  const SceneNodeId window = with("polygon3d", {{0, PointLists{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                                                               {{-0.5, -0.5, 0}, {0, 0.5, 0}, {0.5, -0.5, 0}}}},
                                                {2, choice("polygon3d", 2, 1)}});
  return b.tree(
      b.unite({b.subtract({ring, b.cube({1, 1, 1})}),
               b.translate({3, 0, 0}, b.subtract({b.intersect({nodes, b.sphere(1.2)}), beyond})),
               b.translate({0, 3, 0}, b.subtract({b.intersect({saddle, b.sphere(1)}), b.cylinder(1, 0.3)})),
               b.translate({3, 3, -0.5}, b.subtract({chisel, b.rotate({0, 30, 0}, b.cube({2, 0.4, 0.4}, true))})),
               b.translate({0, 0, 2}, b.subtract({patches, b.sphere(1), ring})),
               b.translate({3, 0, 2}, b.subtract({b.scale(0.6, sheet), b.sphere(0.5)})),
               b.translate({3, 3, 2}, b.subtract({window, b.rotate({0, 0, 30}, chisel)}))}));
}

/// Meshes by either structure within, cut by one another and by what has their faces.
inline CsgTree meshes_scene() {
  SceneBuilder b;
  const auto mesh = [&](TriangleMesh triangles, MeshStructure local) {
    triangles.local = local;
    return b.primitive("mesh", {meshes::share(std::move(triangles)), false});
  };
  const auto ball = meshes::star(3, [](const Vec3& d) { return 1 + 0.2 * d.x * d.y; });
  const SceneNodeId bitten =
      b.subtract({mesh(ball, MeshStructure::bvh), b.translate({0.3, 0.1, 0.2}, mesh(ball, MeshStructure::kd)),
                  mesh(meshes::ring(0.9, 0.3, 12, 8), MeshStructure::kd)});
  const SceneNodeId block = mesh(meshes::box({0, 0, 0}, {1, 1, 1}), MeshStructure::bvh);
  const SceneNodeId flush = b.subtract({block, b.cube({1, 0.5, 0.5}), b.translate({0.5, 0.5, 0}, b.cylinder(1, 0.25))});
  return b.tree(
      b.unite({bitten, b.translate({1.2, 0, 0}, flush), b.translate({-1, -2, 0}, b.rotate({30, 40, 50}, block))}));
}

/// Twisted prisms in one another, and with walls and caps of others in theirs.
inline CsgTree twisted_scene() {
  SceneBuilder b;
  const Outline slot{{{{-1, -0.5, 0}, {1, -0.5, 1}, {1, 0.5, 0}, {-1, 0.5, 1}}}};
  const Outline frame{
      {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0, 0.5, 0}}}};
  const auto twist = [&](const Outline& outline, double h, double degrees, double scale_x, double scale_y) {
    return b.primitive("twisted_prism", {outline, h, false, degrees, scale_x, scale_y});
  };
  const SceneNodeId drill = b.subtract({b.cylinder(2, 1), b.translate({0.9, 0, 0}, twist(slot, 2, 200, 1, 1))});
  const SceneNodeId column =
      b.subtract({twist(frame, 3, 90, 0.5, 1), b.cube({2, 2, 1}, true), twist(slot, 1.5, 45, 0.75, 1)});
  return b.tree(b.unite({drill, b.translate({3, 0, 0}, column), b.translate({0, 3, 0}, twist(slot, 1, 0, 0.25, 2))}));
}

inline CsgTree lattice_scene(std::uint64_t seed, const Vec3& degrees) {
  SceneBuilder b;
  return b.tree(b.rotate(degrees, lattice_node(b, seed)));
}

inline CsgTree room_scene() {
  SceneBuilder b;
  const auto half_space = [&](const Vec3& n, double d) { return b.primitive("halfspace", {n, d}); };
  const SceneNodeId room = b.intersect({half_space({1, 0, 0}, 2), half_space({-1, 0, 0}, 2), half_space({0, 1, 0}, 2),
                                        half_space({0, -1, 0.1}, 2), half_space({0, 0, 1}, 2)});
  return b.tree(b.unite({b.complement(room), b.sphere(1), b.subtract({b.cube({2, 2, 1}), b.sphere(1.2)})}));
}

inline constexpr Scene scenes[] = {
    {"random_8", [] { return random_scene(27, 8, 0.8); }},
    {"random_24", [] { return random_scene(2, 24, 1.5); }},
    {"random_60", [] { return random_scene(3, 60, 3); }},
    {"lattice", [] { return lattice_scene(4, {}); }},
    {"lattice_rotated",
     [] {
       return lattice_scene(5, {12.7, 48.1, 77.7});
     }},
    {"nested", nested_scene},
    {"deep", deep_scene},
    {"flat", flat_scene},
    {"tiny", [] { return sized_scene(16, 1e-9, {}); }},
    {"huge", [] { return sized_scene(17, 1e9, {}); }},
    {"far_away",
     [] {
       return sized_scene(8, 1, {1e5, -3e5, 2e5});
     }},
    {"swarm", swarm_scene},
    {"repeated", repeated_scene},
    {"scales", scales_scene},
    {"same_place", same_place_scene},
    {"media", [] { return media_scene(9, false); }},
    {"media_lattice", [] { return media_scene(10, true); }},
    {"media_tools", media_tools_scene},
    {"room", room_scene},
    {"outlines", outlines_scene},
    {"surfaces", surfaces_scene},
    {"meshes", meshes_scene},
    {"twisted", twisted_scene},
    {"one",
     [] {
       SceneBuilder b;
       return b.tree(b.sphere(1));
     }},
    {"none",
     [] {
       SceneBuilder b;
       return b.tree(b.unite({}));
     }},
    {"cancelled",
     [] {
       SceneBuilder b;
       const auto c = b.cube({1, 1, 1});
       return b.tree(b.subtract({c, c}));
     }},
};

}  // namespace tenon::gallery
