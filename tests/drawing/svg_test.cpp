#include "drawing/svg.h"

#include <gtest/gtest.h>

#include "drawing/svg_path.h"
#include "primitive/arc.h"
#include "primitive/outline_edges.h"

namespace tenon {
namespace {

const std::string head = "<svg xmlns=\"http://www.w3.org/2000/svg\" ";

SvgPicture picture_of(const std::string& text, const SvgOptions& options = {}) {
  Result<SvgPicture> picture = read_svg({"a.svg", text}, options);
  EXPECT_TRUE(picture.ok()) << (picture ? "" : format_error(picture.error()));
  return picture ? std::move(*picture) : SvgPicture{};
}

std::string error_of(const std::string& text) {
  const Result<SvgPicture> picture = read_svg({"a.svg", text}, {});
  return picture ? "no error" : format_error(picture.error());
}

double area_of(const Outline& outline) {
  double sum = 0;
  for (const auto& loop : outline.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()];
      sum += 0.5 * (a.x * b.y - a.y * b.x);
      if (a.bulge == 0) continue;
      const double r = circle_of_arc({a.x, a.y}, {b.x, b.y}, a.bulge).radius, angle = 4 * std::atan(a.bulge);
      sum += 0.5 * r * r * (angle - std::sin(angle));
    }
  }
  // Turned over by the page's y axis.
  return std::fabs(sum);
}

void expect_box(const Outline& outline, const Vec2& lower, const Vec2& upper, double tolerance) {
  Vec2 least{HUGE_VAL, HUGE_VAL}, most{-HUGE_VAL, -HUGE_VAL};
  const OutlineEdges edges(outline);
  for (const OutlineEdge& edge : edges.edges()) {
    for (const Vec2& p : {edge.from, middle_of_arc(edge.from, edge.to, edge.bulge)}) {
      least = min(least, p);
      most = max(most, p);
    }
  }
  EXPECT_NEAR(least.x, lower.x, tolerance);
  EXPECT_NEAR(least.y, lower.y, tolerance);
  EXPECT_NEAR(most.x, upper.x, tolerance);
  EXPECT_NEAR(most.y, upper.y, tolerance);
}

// Against what OpenSCAD 2021.01 makes of them, with segments for curves.
TEST(Svg, DrawsEveryShapeAsOpenscadDoes) {
  const std::string text =
      "<?xml version=\"1.0\"?>\n" + head +
      "width=\"100mm\" height=\"60mm\" viewBox=\"0 0 200 120\">"
      "<rect x=\"10\" y=\"10\" width=\"60\" height=\"40\" rx=\"8\" ry=\"4\"/><circle cx=\"110\" cy=\"30\" r=\"15\"/>"
      "<ellipse cx=\"160\" cy=\"30\" rx=\"20\" ry=\"10\"/>"
      "<path d=\"M10 70 h40 v30 h-40 z M20 80 v10 h10 v-10 z\"/>"
      "<g transform=\"translate(80 70) rotate(20)\">"
      "<path d=\"M0 0 C 0 20 20 30 40 10 S 30 -20 10 -10 Q 0 -10 0 0 Z\"/></g>"
      "<path d=\"M 100 110 A 8 8 0 0 1 116 110 A 10 5 30 1 0 120 115 Z\" fill-rule=\"evenodd\"/>"
      "<polygon points=\"60,60 75,60 70,68\"/></svg>";
  const SvgPicture picture = picture_of(text);
  expect_box(picture.outline, {5, 0.298538}, {90, 55}, 0.02);
  EXPECT_NEAR(area_of(picture.outline), 1560.754, 4);
  EXPECT_TRUE(picture.notes.empty());
}

TEST(Svg, PlacesThePageAsOpenscadDoes) {
  const std::string shapes =
      "<rect x=\"10\" y=\"10\" width=\"30\" height=\"20\"/><circle cx=\"70\" cy=\"25\" r=\"10\"/></svg>";
  expect_box(picture_of(head + "width=\"100\" height=\"50\">" + shapes).outline, {10, -17.3611}, {80, 7.63889}, 1e-4);
  SvgOptions options;
  options.dpi = 96;
  expect_box(picture_of(head + "width=\"100\" height=\"50\">" + shapes, options).outline, {10, -21.7708}, {80, 3.22916},
             1e-4);
  options.center = true;
  expect_box(picture_of(head + "width=\"100\" height=\"50\">" + shapes, options).outline, {-35, -12.5}, {35, 12.5},
             1e-4);
  const std::string rect = "<rect x=\"20\" y=\"30\" width=\"30\" height=\"20\"/></svg>";
  expect_box(picture_of(head + "viewBox=\"10 20 100 50\">" + rect).outline, {3.52777, -7.05554}, {14.1111, 0}, 1e-4);
  expect_box(picture_of(head + ">" + rect).outline, {20, -50}, {50, -30}, 1e-12);
  expect_box(picture_of(head + "width=\"2in\" height=\"3cm\" viewBox=\"0 0 100 50\">" + rect).outline, {10.16, 2.3},
             {25.4, 12.46}, 1e-9);
}

TEST(Svg, TakesLayersAndElements) {
  const std::string text =
      head +
      "><g inkscape:label=\"low\"><rect width=\"1\" height=\"1\"/></g><g inkscape:label=\"high\">"
      "<rect id=\"it\" x=\"5\" width=\"2\" height=\"2\"/><rect x=\"9\" width=\"1\" height=\"1\"/></g></svg>";
  EXPECT_EQ(picture_of(text).outline.loops.size(), 3u);
  SvgOptions options;
  options.layer = "high";
  EXPECT_EQ(picture_of(text, options).outline.loops.size(), 2u);
  options.layer.clear();
  options.id = "it";
  expect_box(picture_of(text, options).outline, {5, -2}, {7, 0}, 1e-12);
}

TEST(Svg, FollowsReferences) {
  const std::string text = head +
                           "><defs><g id=\"g\"><rect width=\"2\" height=\"1\"/></g></defs>"
                           "<use xlink:href=\"#g\" x=\"5\"/><use href=\"#g\" transform=\"scale(2) rotate(90)\"/></svg>";
  const Outline outline = picture_of(text).outline;
  expect_box(outline, {-2, -4}, {7, 0}, 1e-12);
  EXPECT_NEAR(area_of(outline), 10, 1e-9);
}

TEST(Svg, FillsByItsRule) {
  const std::string twice = "<path d=\"M0 0 h9 v9 h-9 z M3 3 h3 v3 h-3 z\"";
  EXPECT_NEAR(area_of(picture_of(head + ">" + twice + "/></svg>").outline), 81, 1e-9);
  EXPECT_NEAR(area_of(picture_of(head + ">" + twice + " style=\"fill-rule: evenodd; fill: red\"/></svg>").outline), 72,
              1e-9);
}

TEST(Svg, SaysWhatItLeavesOut) {
  const SvgPicture picture = picture_of(
      head +
      "><text>a</text><path d=\"M0 0 L 9 9\" fill=\"none\" stroke=\"red\"/><rect width=\"1\" height=\"1\"/></svg>");
  EXPECT_EQ(picture.notes, (std::vector<std::string>{"text is left out", "lines that are not filled are left out"}));
  EXPECT_EQ(picture.outline.loops.size(), 1u);
}

TEST(Svg, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(error_of("").find("a.svg:1:1: error: this is no XML"), std::string::npos) << error_of("");
  EXPECT_NE(error_of("<svg>\n<rect").find("a.svg:2:"), std::string::npos) << error_of("<svg>\n<rect");
  EXPECT_NE(error_of("<html/>").find("an SVG file begins with <svg>"), std::string::npos);
  EXPECT_NE(
      error_of("<svg>\n <path d=\"M 0 0 X\"/></svg>").find("a.svg:2:3: error: the data of this path cannot be read"),
      std::string::npos)
      << error_of("<svg>\n <path d=\"M 0 0 X\"/></svg>");
  EXPECT_NE(error_of("<svg><g id=\"a\"><use href=\"#a\"/></g></svg>").find("nested more than 100 deep"),
            std::string::npos);
}

TEST(SvgPath, ReadsNumbersWithoutSpaces) {
  const auto outline = parse_svg_path("M0,0L1-1.5.5.5A1 1 0 014 0z");
  ASSERT_TRUE(outline.has_value());
  ASSERT_EQ(outline->loops.size(), 1u);
  EXPECT_EQ(outline->loops[0][1], (OutlineCorner{1, -1.5, 0}));
  EXPECT_EQ(outline->loops[0][2].x, 0.5);
  EXPECT_GT(outline->loops[0][2].bulge, 0);
  EXPECT_FALSE(parse_svg_path("L").has_value());
  EXPECT_FALSE(parse_svg_path("M 0 0 C 1 1").has_value());
  EXPECT_TRUE(parse_svg_path("").has_value());
}

}  // namespace
}  // namespace tenon
