#include "lang/language.h"

namespace tenon {
namespace {

Model model_of(const std::string& text) {
  Outcome outcome = evaluate(text);
  EXPECT_TRUE(outcome.model.ok()) << (outcome.model ? "" : format_error(outcome.model.error()));
  return outcome.model ? std::move(*outcome.model) : Model{};
}

std::optional<Rgba> color_of(const std::string& arguments) {
  const Model model = model_of("color(" + arguments + ") cube();");
  const auto* attribute = std::get_if<ColorAttribute>(&model.graph[model.graph.root].content);
  return attribute ? std::optional(attribute->color) : std::nullopt;
}

TEST(Color, NamesHexAndLists) {
  EXPECT_EQ(color_of("\"Red\""), (Rgba{1, 0, 0, 1}));
  EXPECT_EQ(color_of("\"cornflowerblue\", 0.5"), (Rgba{100 / 255.0, 149 / 255.0, 237 / 255.0, 0.5}));
  EXPECT_EQ(color_of("\"#f0a\""), (Rgba{1, 0, 170 / 255.0, 1}));
  EXPECT_EQ(color_of("\"#f0a8\""), (Rgba{1, 0, 170 / 255.0, 136 / 255.0}));
  EXPECT_EQ(color_of("\"#FF000080\""), (Rgba{1, 0, 0, 128 / 255.0}));
  EXPECT_EQ(color_of("[0.1, 0.2, 0.3]"), (Rgba{0.1, 0.2, 0.3, 1}));
  EXPECT_EQ(color_of("c = [0.1, 0.2, 0.3, 0.4]"), (Rgba{0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(color_of("[-1, -1, -1, 1]"), std::nullopt);
  EXPECT_EQ(color_of("\"no such\""), std::nullopt);
  EXPECT_NE(warnings_of("color(\"no such\") cube();").find("there is no colour \"no such\""), std::string::npos);
  EXPECT_NE(warnings_of("color([2, 0, 0]) cube();").find("between 0 and 1"), std::string::npos);
}

TEST(MaterialModule, SetsWhatIsGiven) {
  const Model model = model_of(
      "material(\"shiny\", model = \"whitted\", kd = 0.5, ks = 0.3, kt = 0.2, ka = 0.1, shininess = 7,"
      "ior = 1.5, color = \"blue\", priority = 2) cube();");
  ASSERT_EQ(model.materials.size(), 1u);
  Material expected;
  expected.name = "shiny";
  expected.model = MaterialModel::whitted;
  expected.kd = 0.5, expected.ks = 0.3, expected.kt = 0.2, expected.ka = 0.1;
  expected.shininess = 7, expected.ior = 1.5, expected.priority = 2;
  expected.color = Rgba{0, 0, 1, 1};
  EXPECT_EQ(model.materials[0], expected);
}

TEST(MaterialModule, EqualOnesAreOne) {
  EXPECT_EQ(model_of("for (i = [1:5]) material(\"a\") cube(i); material(\"b\") cube();").materials.size(), 2u);
}

TEST(MaterialModule, PresetsConserveEnergy) {
  for (const char* name :
       {"glass", "water", "mirror", "chrome", "gold", "silver", "copper", "plastic", "matte", "other"}) {
    EXPECT_EQ(warnings_of("material(\"" + std::string(name) + "\") cube();"), "");
  }
  EXPECT_NE(warnings_of("material(kd = 0.5, ks = 0.6) cube();").find("kd + ks + kt is 1.1"), std::string::npos);
  EXPECT_EQ(warnings_of("material(kd = 0.1, ks = 0.2, kt = 0.7) cube();"), "");
}

TEST(MaterialModule, MistakesAreErrors) {
  EXPECT_NE(error_of("material(model = \"whited\") cube();").find("scene.scad:1:10: error: 'model' must be"),
            std::string::npos);
  EXPECT_NE(error_of("material(shinyness = 3) cube();").find("did you mean 'shininess'?"), std::string::npos);
  EXPECT_NE(error_of("material(ior = 0) cube();").find("greater than 0"), std::string::npos);
  EXPECT_NE(error_of("material(kd = -1) cube();").find("at least 0"), std::string::npos);
}

TEST(View, CameraLightsBackgroundAmbient) {
  const Model model = model_of(
      "camera(from = [1, 2, 3], at = [0, 0, 1], fov = 50);"
      "light(type = \"spot\", position = [1, 1, 1], direction = [0, 0, -2], angle = 20, softness = 0.5,"
      "color = \"red\", intensity = 2); background(\"white\"); ambient(0.3); cube();");
  ASSERT_TRUE(model.camera.has_value());
  EXPECT_EQ(model.camera->from, (Vec3{1, 2, 3}));
  EXPECT_EQ(model.camera->at, (Vec3{0, 0, 1}));
  EXPECT_EQ(model.camera->fov, 50);
  ASSERT_EQ(model.lights.size(), 1u);
  EXPECT_EQ(model.lights[0].kind, LightKind::spot);
  EXPECT_EQ(model.lights[0].direction, (Vec3{0, 0, -2}));
  EXPECT_EQ(model.lights[0].intensity, 2);
  EXPECT_EQ(model.background, (Rgba{1, 1, 1, 1}));
  EXPECT_EQ(model.ambient, (Rgba{0.3, 0.3, 0.3, 1}));
}

TEST(View, MovesWithTheTransformsAroundIt) {
  const Model model = model_of("translate([0, 0, 5]) rotate(90) { light(position = [1, 0, 0]); cube(); }");
  ASSERT_EQ(model.lights.size(), 1u);
  EXPECT_EQ(model.lights[0].position, (Vec3{0, 1, 5}));
}

TEST(View, IsNoOperand) {
  EXPECT_EQ(model_of("difference() { light(); cube(2); }").graph.nodes.size(), 1u);
}

TEST(View, MistakesAreErrorsWithTheirPlace) {
  EXPECT_NE(error_of("light(type = \"area\");").find("\"rectangle\""), std::string::npos);
  EXPECT_NE(error_of("light(type = \"sphere\", angle = 3);").find("has no 'angle'"), std::string::npos);
  EXPECT_NE(error_of("light(type = \"environment\", file = \"nowhere.exr\");").find("there is no file"),
            std::string::npos);
  EXPECT_NE(error_of("light(type = \"sky\"); light(type = \"environment\");").find("already"), std::string::npos);
  EXPECT_NE(error_of("light(type = \"lamp\");").find("'type' must be"), std::string::npos);
  EXPECT_NE(error_of("camera(from = 3);").find("list of three"), std::string::npos);
  EXPECT_NE(error_of("camera(from = [1, 1, 1], at = [1, 1, 1]);").find("must differ"), std::string::npos);
  EXPECT_NE(error_of("camera(fov = 180);").find("between 0 and 180"), std::string::npos);
  EXPECT_NE(error_of("camera(fov = 40, orthographic = 3);").find("one of the two"), std::string::npos);
  EXPECT_NE(warnings_of("camera(); camera(fov = 20);").find("more than one camera"), std::string::npos);
}

}  // namespace
}  // namespace tenon
