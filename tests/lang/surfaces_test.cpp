// Ellipsoids, truncated cones, solids of eight vertices, and what polynomials, polygons and patches make.
#include <algorithm>

#include "lang/language.h"

namespace tenon {
namespace {

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Ellipsoid, IsAStretchedSphere) {
  EXPECT_EQ(tree_of("ellipsoid([1, 2, 3]);"),
            "multmatrix([[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 3, 0], [0, 0, 0, 1]]) {\n\tsphere(r = 1);\n}\n");
  EXPECT_TRUE(mentions(warnings_of("ellipsoid([1, 0, 3]); cube(1);"), "no volume"));
  EXPECT_TRUE(mentions(error_of("ellipsoid([1, 0]);"), "list of three"));
}

TEST(TruncatedCone, OfOneProportionIsAConeOrACylinder) {
  EXPECT_EQ(tree_of("truncated_cone(h = 2, a1 = 1, b1 = 1, a2 = 0.5, b2 = 0.5);"),
            "cylinder(h = 2, r1 = 1, r2 = 0.5, center = false);\n");
  EXPECT_TRUE(
      mentions(tree_of("truncated_cone(h = [1, 0, 2], a1 = 1, b1 = 2, a2 = 1, b2 = 2);"),
               "multmatrix([[1, 0, 0.5, 0], [0, 2, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n\tcylinder(h = 2, r = 1"));
  EXPECT_EQ(tree_of("truncated_cone(h = 2, a1 = 1, b1 = 0.5, a2 = 0.25, b2 = 1);"),
            "truncated_cone(h = 2, a1 = 1, b1 = 0.5, a2 = 0.25, b2 = 1);\n");
  const std::string skew = tree_of("truncated_cone(h = [1, -1, 2], a1 = 1, b1 = 0.5, a2 = 0.25, b2 = 1);");
  EXPECT_TRUE(mentions(skew, "[[1, 0, 0.5, 0], [0, 1, -0.5, 0], [0, 0, 1, 0]"));
  EXPECT_EQ(tree_of(skew), skew);
  EXPECT_TRUE(mentions(warnings_of("truncated_cone(h = 0); cube(1);"), "no volume"));
  EXPECT_TRUE(
      mentions(warnings_of("truncated_cone(a1 = 1, b1 = 1, a2 = 1e-5, b2 = 1e-6); cube(1);"), "more than 1024"));
}

TEST(Arb8, IsTheSolidOfItsSixFaces) {
  const std::string box =
      "points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];";
  EXPECT_TRUE(mentions(tree_of(box + "arb8(points);"), "convex_polyhedron("));
  // Vertices in one place make a pyramid, a wedge, a tetrahedron.
  EXPECT_TRUE(mentions(tree_of("p = [0.5, 0.5, 1]; arb8([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], p, p, p, p]);"),
                       "convex_polyhedron("));
  // A dart, swept: flat faces, but not convex.
  EXPECT_TRUE(mentions(tree_of("d = [[0, 0], [2, 1], [4, 0], [2, 4]];"
                               "arb8(concat([for (p = d) [p.x, p.y, 0]], [for (p = d) [p.x, p.y, 1]]));"),
                       "polyhedron(points"));
  const std::string bent =
      error_of("arb8([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1.5], [0, 1, 1]]);");
  EXPECT_TRUE(mentions(bent, "face of points 4, 5, 6, 7 is not flat")) << bent;
  EXPECT_TRUE(mentions(bent, "by 0.117851")) << bent;
  EXPECT_TRUE(mentions(error_of("arb8([[0, 0, 0]]);"), "needs eight points"));
}

TEST(Polynomials, ReadBackAsTheyWerePrinted) {
  for (const char* scene :
       {"quadric([1, 2, 3, 0, 0, 0, 0, 0, 0.1, -1]);",
        "quadric([1, 1, -1, 0, 0, 0, 0, 0, 0, 0], box = [[-1, -1, -1], [1, 2, 1]]);",
        "algebraic([[6, 0, 0, 1], [0, 2, 4, -0.5], [0, 0, 0, -1]], box = [[1, 1, 1], [-1, -1, -1]]);",
        "algebraic([[2, 0, 0, 1], [0, 2, 0, 1], [0, 0, 0, -1]], isolation = \"collins\", refinement = \"bairstow\");",
        "polygon3d([[0, 0, 0], [1, 0, 0], [1, 1, 0]]);",
        "polygon3d([[[0, 0, 0], [3, 0, 0], [0, 3, 0]], [[1, 1, 0], [2, 1, 0], [1, 2, 0]]], method = \"marchal\");",
        "polygon3d([[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 1], [0, 1, 1], [1, 0, 1]]);", "bicubic();",
        "bicubic([for (y = [0 : 5]) [for (x = [0 : 4]) [x, y, x * y % 3]]], basis = \"betaspline\", bias = 2,"
        " tension = 3, method = \"resultant\");"}) {
    const std::string text = tree_of(scene);
    EXPECT_FALSE(mentions(text, "error")) << text;
    EXPECT_EQ(tree_of(text), text);
  }
}

TEST(Polynomials, WhatIsNoneIsSaidSo) {
  EXPECT_TRUE(mentions(error_of("algebraic(3);"), "list of [i, j, k, a]"));
  EXPECT_TRUE(mentions(error_of("algebraic([[1, 0, 0, 1], [0.5, 0, 0, 1]]);"), "term 1 is none"));
  EXPECT_TRUE(mentions(warnings_of("algebraic([[13, 0, 0, 1]]); cube(1);"), "degree 13"));
  EXPECT_TRUE(mentions(warnings_of("algebraic([[-1, 0, 0, 1]]); cube(1);"), "negative exponent"));
  EXPECT_TRUE(mentions(warnings_of("algebraic([[0, 0, 0, 1]]); cube(1);"), "constant"));
  EXPECT_TRUE(
      mentions(error_of("algebraic(isolation = \"sturm\");"), "'isolation' must be \"interval\" or \"collins\""));
  EXPECT_TRUE(mentions(error_of("algebraic(box = [1, 2, 3]);"), "two corners"));
  EXPECT_TRUE(mentions(error_of("quadric([1, 2, 3]);"), "ten numbers"));
  EXPECT_TRUE(mentions(error_of("polygon3d([[0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 0]]); cube(1);"), "not planar"));
  EXPECT_TRUE(mentions(error_of("bicubic([[1, 2], [3, 4]]);"), "net of control points"));
}

// Newell's teapot is symmetric, and no patch of it hangs in the air: every edge is one of another patch, a point, or
// one of those that lie inside (the lid's and the rim's rings, the ends of the handle and the spout).
TEST(Teapot, IsSymmetricAndItsPatchesMeet) {
  Diagnostics diagnostics;
  const auto model = load_model(std::string(TENON_SCENES) + "/teapot.scad", {}, diagnostics);
  ASSERT_TRUE(model.ok()) << format_error(model.error());
  const PrimitiveStore& store = model->graph.primitives;
  const ControlNets* nets = nullptr;
  for (std::size_t i = 0; i < store.size(); ++i) {
    if (store.kind(PrimitiveId{i}).name != "bicubic") continue;
    static std::vector<FieldValue> values;
    values = store.values(PrimitiveId{i});
    nets = &std::get<ControlNets>(values[0]);
  }
  ASSERT_NE(nets, nullptr);
  ASSERT_EQ(nets->size(), 32u);
  const auto mirrored = [](PointLists net) {
    for (auto& row : net) {
      for (Vec3& p : row) p.y = -p.y + 0.0;
    }
    return net;
  };
  const auto plain = [](PointLists net) {
    for (auto& row : net) {
      for (Vec3& p : row) p += Vec3{};
    }
    return net;
  };
  std::vector<std::vector<Vec3>> edges;
  for (const PointLists& net : *nets) {
    const PointLists other = mirrored(net);
    EXPECT_TRUE(std::any_of(nets->begin(), nets->end(), [&](const PointLists& n) { return plain(n) == other; }));
    std::vector<Vec3> left, right;
    for (const auto& row : net) {
      left.push_back(row.front());
      right.push_back(row.back());
    }
    edges.insert(edges.end(), {net.front(), net.back(), left, right});
  }
  int open = 0;
  for (const auto& edge : edges) {
    const std::vector<Vec3> reversed(edge.rbegin(), edge.rend());
    const auto same =
        std::count_if(edges.begin(), edges.end(), [&](const auto& e) { return e == edge || e == reversed; });
    const bool is_point = edge[0] == edge[1] && edge[1] == edge[2];
    open += same == 1 && !is_point;
  }
  // Four quarters each of the lid's lower ring and the rim's inner one; two halves each of four ends.
  EXPECT_EQ(open, 16);
}

}  // namespace
}  // namespace tenon
