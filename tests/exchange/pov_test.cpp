#include "tenon/exchange/pov.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "support/scene_builder.h"
#include "tenon/accel/accelerator.h"
#include "tenon/film/film_picture.h"
#include "tenon/lang/load.h"
#include "tenon/math/color.h"
#include "tenon/render/renderer.h"

// The text is judged by reading it, and where Debian's povray is installed by the pictures POV-Ray makes of it.
namespace tenon {
namespace {

constexpr int width = 120, height = 90, depth = 4;

Scene scene_of(const std::string& text) {
  Diagnostics diagnostics;
  Result<Model> model = load_model_text(text, "test.scad", {}, diagnostics);
  EXPECT_TRUE(model.ok()) << (model ? "" : format_error(model.error()));
  Result<Scene> scene = compile_scene(std::move(*model), diagnostics);
  EXPECT_TRUE(scene.ok()) << (scene ? "" : format_error(scene.error()));
  return std::move(*scene);
}

std::string pov_of(const std::string& text) {
  const Result<std::string> pov = print_pov(scene_of(text), depth);
  EXPECT_TRUE(pov.ok()) << (pov ? "" : format_error(pov.error()));
  return *pov;
}

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

const std::string stage = R"(
  camera(from = [3, -5, 4], at = [0.2, 0.1, 0], fov = 40);
  light(type = "point", position = [8, -10, 14], intensity = 0.75);
  light(type = "point", position = [-12, -6, 9], intensity = 0.4, color = [1, 0.8, 0.6]);
  ambient([0.5, 0.6, 0.7]); background([0.2, 0.4, 0.8]);
  module clay() material("clay", model = "phong", ka = 0.3, kd = 0.7, ks = 0.3, shininess = 25, color = [0.9, 0.5, 0.2])
    children();
  module floor() material("floor", kd = 1, ks = 0, color = [0.6, 0.7, 0.6]) translate([-9, -9, -2]) cube([18, 18, 0.5]);
)";

// One scene for everything the file may hold.
const std::map<std::string, std::string> scenes{
    {"sphere", "clay() translate([0.3, 0, 0]) scale([1, 1.4, 0.7]) sphere(1); floor();"},
    {"cube", "clay() rotate([10, 20, 30]) cube([1, 2, 1.5], center = true); floor();"},
    {"cylinder", "clay() rotate([50, 20, 30]) cylinder(h = 2, r = 0.8); floor();"},
    {"cone", "clay() rotate([50, 20, 30]) cylinder(h = 2, r1 = 0.9, r2 = 0.3, center = true); floor();"},
    {"torus", "clay() rotate([30, 20, 0]) torus(R = 1, r = 0.35); floor();"},
    {"hyperboloid", "clay() rotate([20, 20, 0]) hyperboloid(h = 2, r = 1, waist = 0.4); floor();"},
    {"paraboloid", "clay() rotate([140, 20, 0]) paraboloid(h = 1.5, r = 1); floor();"},
    {"halfspace", "clay() intersection() { sphere(1.2); halfspace(normal = [2, -2, 1], d = 0.9); } floor();"},
    {"convex_polyhedron", "clay() rotate([0, 0, 20]) cylinder(h = 1.5, r = 1, $fn = 5); floor();"},
    {"quadric",
     "clay() rotate([0, 30, 0]) quadric([1, 2, -1, 0.5, 0, 0.25, 0, 0.125, 0, -0.5], box = [[-1, -1, -1], [1, 1, "
     "1.2]]);"
     " floor();"},
    {"quadric_unbounded",
     "clay() intersection() { quadric([1, 1, -0.5, 0, 0, 0, 0, 0, 0, -0.2]); sphere(1.5); } floor();"},
    {"algebraic",
     "clay() rotate([20, 0, 30]) algebraic([[4, 0, 0, 1], [0, 4, 0, 1], [0, 0, 4, 1], [0, 0, 0, -1]],"
     " box = [[-1.1, -1.1, -1.1], [0.8, 1.1, 1.1]]); floor();"},
    {"polygon3d",
     "clay() rotate([20, 0, 30]) polygon3d([[[-1, -1, 0], [1, -1, 0], [1, 1, 1], [-1, 1, 1]],"
     " [[-0.5, -0.5, 0.25], [0.5, -0.5, 0.25], [0, 0.5, 0.75]]]); floor();"},
    {"complement", "clay() intersection() { cube(1.6, center = true); complement() sphere(1); } floor();"},
    {"mirrored", "clay() mirror([1, 0.3, 0]) difference() { cube(1); translate([1, 1, 1]) sphere(0.6); } floor();"},
    {"difference",
     "clay() difference() { sphere(1); union() { cube(2); torus(R = 1, r = 0.2); } cube([3, 0.3, 0.3]); }"},
    {"cut_shows_tool",
     "difference() { clay() sphere(1); color(\"green\") translate([0, -1, 0.3]) sphere(0.8); } floor();"},
    {"cut_shows_minuend",
     "difference() { union() { clay() sphere(1); color(\"red\") translate([1.75, 0, 0]) sphere(0.7); }"
     " translate([0.9, -0.5, 0.4]) sphere(0.8); }"},
    {"nothing_in_it", "clay() difference() { sphere(1); union() {} intersection() { cube(1); union() {} } }"},
    {"default_material", "cube(1); floor();"},
    {"mirror", "floor(); material(\"chrome\") sphere(1); color(\"red\") translate([1.5, -1, 0]) sphere(0.4);"},
    {"glass",
     "floor(); material(\"g\", model = \"whitted\", kd = 0.1, ks = 0.2, kt = 0.7, ior = 1.5, shininess = 30,"
     " color = [0.8, 0.9, 1]) sphere(1); color(\"red\") translate([-1, 1.5, 0]) sphere(0.6);"},
    {"spot",
     "clay() sphere(0.5); floor(); light(type = \"spot\", position = [0, 0, 5], direction = [0.1, 0, -1], angle = 20,"
     " softness = 0.5);"},
    {"directional",
     "clay() sphere(1); floor(); light(type = \"directional\", direction = [1, 2, -2], intensity = 0.6);"},
    {"orthographic", "clay() cube(1); floor(); camera(from = [3, -5, 4], at = [0, 0, 0], orthographic = 5);"},
};

// A primitive that is new has a scene here, or a message that names it: pictures never lack a part in silence.
TEST(Pov, EveryPrimitiveIsWrittenOrRefusedByName) {
  const std::map<std::string, std::string> refused{
      {"prism", "linear_extrude(2) polygon([[0, 0], [2, 0], [1, 0.5], [0, 2]]);"},
      {"revolution", "rotate_extrude() translate([2, 0]) polygon([[0, 0], [1, 0], [0, 2]]);"},
      {"truncated_cone", "truncated_cone(h = 2, a1 = 1, b1 = 0.5, a2 = 0.5, b2 = 1);"},
      {"bicubic", "bicubic([for (y = [0 : 3]) [for (x = [0 : 3]) [x, y, x == 0 || x == 3 ? 0 : 1]]]);"},
      {"twisted_prism", "linear_extrude(2, twist = 90) square(1);"},
      {"mesh",
       "polyhedron([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [0.5, 0.5, 0.5]],"
       " [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 4], [3, 2, 4], [2, 1, 4]]);"}};
  for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
    const std::string name(kind.name);
    if (scenes.count(name) != 0) continue;
    ASSERT_EQ(refused.count(name), 1u) << name;
    const Result<std::string> pov = print_pov(scene_of(refused.at(name)), depth);
    ASSERT_FALSE(pov.ok()) << name;
    EXPECT_NE(pov.error().message.find(name), std::string::npos) << pov.error().message;
  }
}

TEST(Pov, BracesMeetAndNumbersAreFinite) {
  for (const auto& [name, text] : scenes) {
    const std::string pov = pov_of(stage + text);
    EXPECT_EQ(count(pov, "{"), count(pov, "}")) << pov;
    EXPECT_EQ(count(pov, "inf") + count(pov, "nan"), 0) << pov;
  }
}

TEST(Pov, NumbersReadBackToTheSameDoubles) {
  const std::string pov = pov_of("sphere(0.1); translate([1/3, -2e-9, 3e20]) sphere(1);");
  const std::string axes = "matrix <1, 0, 0, 0, 1, 0, 0, 0, 1, ";
  const char* at = pov.data() + pov.find(axes) + axes.size();
  for (const double expected : {1.0 / 3, -2e-9, 3e20}) {
    double number = 0;
    at = std::from_chars(at, pov.data() + pov.size(), number).ptr + 2;
    EXPECT_EQ(number, expected);
  }
}

TEST(Pov, UnionsThatOnlyCostTimeAreLeftOut) {
  const std::string pov = pov_of("difference() { cube(9); union() { sphere(1); union() { sphere(2); sphere(3); } } }");
  EXPECT_EQ(count(pov, "union"), 0) << pov;
  EXPECT_EQ(count(pov, "difference"), 1) << pov;
  EXPECT_EQ(count(pov_of("intersection() { cube(9); union() { sphere(1); sphere(2); } }"), "union"), 1);
  EXPECT_EQ(count(pov_of("union() { cube(9); union() { sphere(1); sphere(2); } }"), "union"), 0);
}

TEST(Pov, MaterialsStandAtTheOutermostPlace) {
  EXPECT_EQ(count(pov_of(stage + "clay() difference() { cube(1); sphere(1); }"), "material { Material_0 }"), 1);
  EXPECT_EQ(count(pov_of(stage + scenes.at("cut_shows_minuend")), "cutaway_textures"), 1);
}

TEST(Pov, WhatCannotBeSaidIsAnError) {
  fixtures::SceneBuilder build;
  Model model;
  model.graph = build.finish(build.intersect({build.sphere(1), build.complement(build.unite({}))}));
  Diagnostics diagnostics;
  const Result<Scene> scene = compile_scene(std::move(model), diagnostics);
  ASSERT_TRUE(scene.ok());
  const Result<std::string> pov = print_pov(*scene, depth);
  ASSERT_FALSE(pov.ok());
  EXPECT_NE(pov.error().message.find("complement of nothing"), std::string::npos);
}

using Picture = std::vector<double>;  // encoded, 0 to 255

Picture tenon_picture(const std::string& text) {
  const Scene scene = scene_of(text);
  const auto accelerator = build_accelerator("none", *scene.tree);
  RenderOptions options;
  options.width = width, options.height = height, options.depth = depth;
  const Result<Rendering> rendering = render(scene, **accelerator, options);
  Picture picture;
  for (const float v : display_pixels(film_picture(rendering->film, {}, 32), {}, false).rgb) {
    picture.push_back(255 * srgb_from_linear(static_cast<double>(v)));
  }
  return picture;
}

// Nothing when POV-Ray is not there or refuses the file.
std::optional<Picture> povray_picture(const std::string& text) {
  std::string folder = (std::filesystem::temp_directory_path() / "tenon-pov-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return std::nullopt;
  const std::string at = folder + "/scene";
  std::ofstream(at + ".pov") << pov_of(text);
  // A PPM file of linear light is read in three lines.
  const std::string line = "povray +I" + at + ".pov +O" + at + ".ppm +FP16 File_Gamma=1 +W" + std::to_string(width) +
                           " +H" + std::to_string(height) + " -D -A +WT1 >" + at + ".log 2>&1";
  const int status = std::system(line.c_str());
  std::ifstream file(at + ".ppm", std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove_all(folder);
  constexpr std::size_t size = 3 * width * height;
  if (status != 0 || bytes.size() < 2 * size) return std::nullopt;
  Picture picture;
  for (std::size_t i = bytes.size() - 2 * size; i < bytes.size(); i += 2) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[k])); };
    picture.push_back(255 * srgb_from_linear((byte(i) * 256 + byte(i + 1)) / 65535.0));
  }
  return picture;
}

double mean_difference(const Picture& a, const Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::fabs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

bool has_povray() {
  return std::system("povray --version >/dev/null 2>&1") == 0;
}

// Of 255 steps. Both programs compute the same formula, so what is left is where a pixel's centre lies on the other
// side of an edge: a pixel of ten thousand by a hundred steps.
constexpr double same = 0.01;

TEST(Pov, PovRayDrawsTheSamePicture) {
  if (!has_povray()) GTEST_SKIP() << "install Debian's povray package to run this";
  for (const auto& [name, text] : scenes) {
    const std::optional<Picture> picture = povray_picture(stage + text);
    ASSERT_TRUE(picture) << name;
    EXPECT_LT(mean_difference(tenon_picture(stage + text), *picture), same) << name;
  }
}

TEST(Pov, ADifferentSceneIsToldApart) {
  if (!has_povray()) GTEST_SKIP() << "install Debian's povray package to run this";
  const std::optional<Picture> picture = povray_picture(stage + scenes.at("difference"));
  ASSERT_TRUE(picture);
  EXPECT_GT(mean_difference(tenon_picture(stage + "clay() difference() { sphere(1); cube(2); cube([3, 0.3, 0.3]); }"),
                            *picture),
            20 * same);
  EXPECT_GT(mean_difference(tenon_picture(stage + "clay() translate([0.01, 0, 0]) " +
                                          scenes.at("difference").substr(std::string("clay() ").size())),
                            *picture),
            same);
}

}  // namespace
}  // namespace tenon
