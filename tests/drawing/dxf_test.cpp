#include <gtest/gtest.h>

#include <fstream>

#include "drawing/load_drawing.h"
#include "drawing/spline.h"
#include "primitive/outline_edges.h"

namespace tenon {
namespace {

// Every kind of entity, each on a layer of its own.
Drawing everything() {
  std::ifstream stream(TENON_FUZZ_CORPUS "/dxf/everything", std::ios::binary);
  Result<Drawing> drawing = parse_drawing({"everything.dxf", {std::istreambuf_iterator<char>(stream), {}}});
  EXPECT_TRUE(drawing.ok()) << (drawing ? "" : format_error(drawing.error()));
  return std::move(*drawing);
}

Outline outline_of(const std::string& layer) {
  const DrawnOutline drawn = outline_of_layer(everything(), layer);
  EXPECT_EQ(drawn.open_paths, 0u);
  return drawn.outline;
}

std::string error_of(const std::string& text) {
  const Result<Drawing> drawing = parse_drawing({"a.dxf", text});
  return drawing ? "no error" : format_error(drawing.error());
}

std::string entities(const std::string& text) {
  return "0\nSECTION\n2\nENTITIES\n" + text + "0\nENDSEC\n0\nEOF\n";
}

TEST(Dxf, JoinsLinesAndArcsOfAnySense) {
  const Outline frame = outline_of("frame");
  ASSERT_EQ(frame.loops.size(), 1u);
  EXPECT_EQ(frame.loops[0].size(), 4u);
  const OutlineEdges edges(frame);
  EXPECT_TRUE(edges.contains({5, 9.999}));
  EXPECT_FALSE(edges.contains({5, 10.001}));
  EXPECT_TRUE(edges.contains({0.001, 0.001}));
  EXPECT_FALSE(edges.contains({1, 9}));
}

TEST(Dxf, KeepsBulges) {
  EXPECT_EQ(outline_of("slot"), (Outline{{{{-1, -1, 0}, {1, -1, 1}, {1, 1, 0}, {-1, 1, 1}}}}));
  EXPECT_EQ(outline_of("old"), (Outline{{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0.5}}}}));
}

TEST(Dxf, FitsArcsToEllipsesAndSplines) {
  const OutlineEdges ellipse(outline_of("ellipse"));
  for (int i = 0; i < 100; ++i) {
    const Vec2 p{4 * std::cos(i), 2 * std::sin(i)};
    EXPECT_TRUE(ellipse.contains((1 - 1e-5) * p));
    EXPECT_FALSE(ellipse.contains((1 + 1e-5) * p));
  }
  // This one is a Bézier curve, whose polynomials are known.
  const Outline outline = outline_of("spline");
  const OutlineEdges spline(outline);
  for (const double t : {0.1, 0.3, 0.5, 0.9}) {
    const double s = 1 - t;
    const Vec2 p{3 * 4 * s * t * t + 4 * t * t * t, 3 * 4 * s * s * t + 3 * 4 * s * t * t};
    EXPECT_TRUE(spline.contains({p.x, p.y - 1e-4})) << t;
    EXPECT_FALSE(spline.contains({p.x, p.y + 1e-4})) << t;
  }
}

TEST(Dxf, InsertsBlocksOnTheirLayer) {
  // A circle of radius 2, around the block's base, twice as long along x, then turned.
  const OutlineEdges block(outline_of("block"));
  EXPECT_TRUE(block.contains({20, 3.999}));
  EXPECT_FALSE(block.contains({20, 4.001}));
  EXPECT_TRUE(block.contains({18.001, 0}));
  EXPECT_FALSE(block.contains({17.999, 0}));
}

TEST(Dxf, MeasuresAndCrosses) {
  Drawing drawing = everything();
  EXPECT_EQ(*measure(drawing, "", "width"), 7);
  EXPECT_EQ(*crossing(drawing, "cross"), (Vec2{3, 0}));
  EXPECT_FALSE(measure(drawing, "frame", "width").ok());
  EXPECT_FALSE(crossing(drawing, "frame").ok());
  place(drawing, {1, 2}, 3);
  EXPECT_EQ(*measure(drawing, "", ""), 21);
  EXPECT_EQ(*crossing(drawing, "cross"), (Vec2{6, -6}));
}

TEST(Dxf, ClosesWhatIsOpen) {
  const std::string line = "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n4\n21\n0\n0\nLINE\n8\n0\n10\n4\n20\n0\n11\n4\n21\n4\n";
  const Result<Drawing> drawing = parse_drawing({"a.dxf", entities(line)});
  ASSERT_TRUE(drawing.ok());
  const DrawnOutline drawn = outline_of_layer(*drawing, "");
  EXPECT_EQ(drawn.open_paths, 1u);
  EXPECT_TRUE(OutlineEdges(drawn.outline).contains({3, 1}));
}

TEST(Dxf, SaysWhatItLeavesOut) {
  EXPECT_EQ(everything().notes, std::vector<std::string>{"TEXT is no line of an outline; it is left out"});
}

TEST(Dxf, SaysWhatIsWrongAndWhere) {
  EXPECT_NE(error_of("").find("a.dxf: error: the file is empty"), std::string::npos) << error_of("");
  EXPECT_NE(error_of("solid x\n").find("a.dxf:1:1: error: a group code is expected"), std::string::npos);
  EXPECT_NE(error_of("AutoCAD Binary DXF\r\n").find("save it as text"), std::string::npos);
  EXPECT_NE(error_of("0\nSECTION\n10\n1.5x\n").find("a.dxf:4:1: error: a finite number is expected"),
            std::string::npos);
  EXPECT_NE(error_of("0\nSECTION\n2").find("cut off"), std::string::npos);
  EXPECT_NE(error_of(entities("0\nINSERT\n2\nnone\n")).find("a.dxf:6:1: error: there is no block 'none'"),
            std::string::npos);
  EXPECT_NE(error_of(entities("0\nSPLINE\n71\n3\n10\n0\n20\n0\n")).find("more control points than its degree"),
            std::string::npos);
}

TEST(Dxf, EndsBlocksThatInsertThemselves) {
  const std::string insert = "0\nINSERT\n2\nA\n70\n1000\n71\n1000\n";
  const std::string blocks =
      "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nA\n" + insert + "0\nENDBLK\n0\nENDSEC\n" + entities(insert);
  EXPECT_NE(error_of(blocks).find("16 deep, or in a circle"), std::string::npos) << error_of(blocks);
  const std::string points = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nA\n0\nPOINT\n0\nENDBLK\n0\nENDSEC\n" +
                             entities("0\nINSERT\n2\nA\n70\n100000\n71\n100000\n");
  EXPECT_NE(error_of(points).find("more than 4 million"), std::string::npos) << error_of(points);
}

}  // namespace
}  // namespace tenon
