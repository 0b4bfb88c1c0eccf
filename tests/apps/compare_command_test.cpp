#include "apps/program_test.h"

namespace tenon {
namespace {

class CompareCommand : public ProgramTest {};

// Every structure answers the rays of a picture as `none` does: of opaque solids, and where light goes through some.
TEST_F(CompareCommand, StructuresAgreeWhereLightPassesBoundaries) {
  const std::string solids =
      "cube([10, 10, 2]); difference() { translate([5, 5, 5]) sphere(3); translate([5, 0, 5]) cube(4); }\n";
  write("opaque.scad", solids);
  write("translucent.scad", solids + "color(\"red\", 0.4) translate([1, 1, 2]) cube([4, 4, 6]);\n");
  for (const std::string scene : {"opaque.scad", "translucent.scad"}) {
    const Outcome outcome = run({"compare", scene, "--size", "40x30", "-q"});
    EXPECT_EQ(outcome.status, 0) << scene << outcome.err;
    EXPECT_TRUE(contains(outcome.out, "cells")) << scene;
  }
}

}  // namespace
}  // namespace tenon
