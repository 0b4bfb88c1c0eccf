// Lines of text against what OpenSCAD 2021.01 makes of them in the same font.
#include "text/typeset.h"

#include <gtest/gtest.h>

#include "primitive/arc.h"
#include "primitive/outline_edges.h"

namespace tenon {
namespace {

using H = HorizontalAlignment;
using V = VerticalAlignment;

struct Line {
  std::string text, font;
  TextStyle style;
  Vec2 lower, upper;  // of OpenSCAD's
  double area = 0;
};

TextStyle styled(double size, HorizontalAlignment horizontal, VerticalAlignment vertical, double spacing = 1,
                 const std::string& direction = "") {
  TextStyle style;
  style.size = size;
  style.horizontal = horizontal;
  style.vertical = vertical;
  style.spacing = spacing;
  style.direction = direction;
  return style;
}

// Twice the area that a loop encloses, with what its arcs add to their chords.
double twice_area(const std::vector<OutlineCorner>& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()];
    sum += a.x * b.y - a.y * b.x;
    if (a.bulge == 0) continue;
    const Circle circle = circle_of_arc({a.x, a.y}, {b.x, b.y}, a.bulge);
    const double angle = 4 * std::atan(a.bulge);
    sum += circle.radius * circle.radius * (angle - std::sin(angle));
  }
  return sum;
}

TEST(Typeset, SetsLinesAsOpenscadDoes) {
  const std::vector<Line> lines{
      {"HgM", "Liberation Sans", {}, {1.1393, -2.8820}, {27.7679, 9.5548}, 102.733},
      {"HgM", "Liberation Sans", styled(20, H::center, V::center), {-26.3581, -12.2765}, {26.8990, 12.5971}, 410.932},
      {"AVAj",
       "Liberation Sans:style=Bold",
       styled(10, H::right, V::top, 1.5),
       {-45.2419, -12.7132},
       {-2.7705, 0.2321},
       135.841},
      {"ab",
       "Liberation Sans",
       styled(10, H::left, V::baseline, 1, "ttb"),
       {-3.1816, -24.0768},
       {3.9522, -2.4745},
       51.5208},
      {"abg",
       "Liberation Sans",
       styled(10, H::center, V::top, 1, "ttb"),
       {-6.6727, 1.2505},
       {0.4678, 35.7122},
       82.5844},
      {"abc",
       "Liberation Sans",
       styled(10, H::left, V::baseline, 1, "rtl"),
       {0.5900, -0.1356},
       {22.0488, 10.0634},
       69.0946},
      {"g\u00c4\u20ac fi",
       "Liberation Sans",
       styled(10, H::left, V::bottom),
       {0.5832, -0.0632},
       {33.8196, 14.4418},
       114.511},
  };
  for (const Line& line : lines) {
    SCOPED_TRACE(line.text);
    const Result<FontFile> font = find_font(line.font);
    ASSERT_TRUE(font.ok() && font->is_asked_for) << "Debian's fonts-liberation is missing";
    const Result<TypesetText> set = typeset(line.text, *font, line.style);
    ASSERT_TRUE(set.ok());
    Vec2 lower{HUGE_VAL, HUGE_VAL}, upper{-HUGE_VAL, -HUGE_VAL};
    double area = 0;
    for (const TypesetText::Place& place : set->places) {
      const OutlineEdges edges(set->glyphs[place.glyph]);
      for (const OutlineEdge& edge : edges.edges()) {
        for (const Vec2& p : {edge.from, middle_of_arc(edge.from, edge.to, edge.bulge)}) {
          lower = min(lower, p + place.at);
          upper = max(upper, p + place.at);
        }
      }
      for (const auto& loop : set->glyphs[place.glyph].loops) area += 0.5 * twice_area(loop);
    }
    // OpenSCAD has segments for curves, and rounds to a grid of 1/512.
    EXPECT_NEAR(lower.x, line.lower.x, 0.005);
    EXPECT_NEAR(lower.y, line.lower.y, 0.005);
    EXPECT_NEAR(upper.x, line.upper.x, 0.005);
    EXPECT_NEAR(upper.y, line.upper.y, 0.005);
    EXPECT_NEAR(area, line.area, 8e-3 * line.area);
  }
}

TEST(Typeset, StoresAGlyphOnce) {
  const Result<TypesetText> set = typeset("ABBA A", *find_font("Liberation Sans"), {});
  ASSERT_TRUE(set.ok());
  EXPECT_EQ(set->glyphs.size(), 3u);  // the space has none
  EXPECT_EQ(set->places.size(), 5u);
}

TEST(Typeset, CutsCurvesWhereFacetsAreWanted) {
  TextStyle style;
  style.segments = 2;
  const Result<TypesetText> set = typeset("O", *find_font("Liberation Sans"), style);
  ASSERT_TRUE(set.ok());
  for (const auto& loop : set->glyphs[0].loops) {
    for (const OutlineCorner& corner : loop) EXPECT_EQ(corner.bulge, 0);
  }
}

TEST(FindFont, SaysWhenAnotherStandsIn) {
  ASSERT_TRUE(find_font("liberation sans")->is_asked_for);
  const Result<FontFile> other = find_font("No Such Family:style=Bold");
  ASSERT_TRUE(other.ok());
  EXPECT_FALSE(other->is_asked_for);
  EXPECT_FALSE(find_font(":").ok() && find_font(":")->path.empty());
}

TEST(Typeset, RefusesAFileThatIsNoFont) {
  EXPECT_FALSE(typeset("A", {"/dev/null", 0, "", "", true}, {}).ok());
}

}  // namespace
}  // namespace tenon
