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

TEST(MaterialModule, MicrofacetModels) {
  const Model model = model_of(
      "translate([1, 2, 3]) material(model = \"principled\", color = \"red\", roughness = 0.2, metallic = 0.3,"
      "transmission = 0.4, coat = 0.5, coat_roughness = 0.6, ior = 1.7, emission = 8, attenuation_color = [0, 1, 0],"
      "attenuation_distance = 9, texture = \"wood\", texture_color = \"blue\", texture_size = 2, turbulence = 3) "
      "cube();"
      "material(\"gold\", model = \"conductor\") cube();"
      "material(model = \"dielectric\") cube();");
  ASSERT_EQ(model.materials.size(), 3u);
  Material expected;
  expected.model = MaterialModel::principled;
  expected.color = Rgba{1, 0, 0, 1};
  expected.roughness = 0.2, expected.metallic = 0.3, expected.transmission = 0.4, expected.coat = 0.5;
  expected.coat_roughness = 0.6, expected.ior = 1.7, expected.emission = 8;
  expected.attenuation_color = {0, 1, 0, 1}, expected.attenuation_distance = 9;
  expected.texture.kind = TextureKind::wood;
  expected.texture.second = {0, 0, 1, 1}, expected.texture.size = 2, expected.texture.turbulence = 3;
  expected.texture.texture_from_world = Affine3::translate({-1, -2, -3});
  EXPECT_EQ(model.materials[0], expected);
  EXPECT_EQ(model.materials[1].color, (Rgba{1, 0.78, 0.34, 1})) << "a preset keeps its colour";
  EXPECT_EQ(model.materials[2].ior, 1.5) << "glass, when nobody says";
}

TEST(MaterialModule, RefusesWhatAModelHasNot) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"model = \"lambert\", roughness = 1", "has no 'roughness'"},
      {"model = \"conductor\", ior = 2", "has no 'ior'"},
      {"model = \"dielectric\", metallic = 1", "has no 'metallic'"},
      {"roughness = 0.5", "has no 'roughness'"},
      {"model = \"principled\", kd = 0.5", "has no 'kd'"},
      {"model = \"principled\", roughness = 1.5", "between 0 and 1"},
      {"texture_size = 2", "needs a 'texture'"},
      {"texture = \"stone\"", "\"marble\""},
      {"model = \"dielectric\", attenuation_distance = 2", "give both"},
      {"model = \"conductor\", attenuation_color = \"red\", attenuation_distance = 1", "opaque"}};
  for (const auto& [arguments, message] : mistakes) {
    const std::string error = error_of("material(" + std::string(arguments) + ") cube();");
    EXPECT_NE(error.find(message), std::string::npos) << arguments << ": " << error;
  }
}

TEST(LightModule, RectanglesMoveWithWhatIsAroundThem) {
  const Model model = model_of(
      "light(type = \"rectangle\", position = [0, 0, 5], size = [2, 3]);"
      "mirror([0, 0, 1]) light(type = \"rectangle\", position = [0, 0, 5], size = [2, 3]);"
      "scale(2) light(type = \"sphere\", radius = 3);"
      "rotate([0, 0, 90]) light(type = \"environment\");");
  ASSERT_EQ(model.lights.size(), 4u);
  EXPECT_LT(model.lights[0].direction.z, 0);
  EXPECT_EQ(length(model.lights[0].edge_u), 2);
  EXPECT_EQ(length(model.lights[0].edge_v), 3);
  EXPECT_GT(model.lights[1].direction.z, 0) << "a mirror image faces the other way";
  EXPECT_EQ(model.lights[1].position, (Vec3{0, 0, -5}));
  EXPECT_NEAR(model.lights[2].radius, 6, 1e-12);
  EXPECT_NEAR(model.lights[3].turn, 90, 1e-12);
  // Printed and read again, to the last bit.
  const Model again = model_of(print_csg(model) + " cube();");
  EXPECT_EQ(again.lights[1].edge_u, model.lights[1].edge_u);
  EXPECT_EQ(again.lights[1].direction, model.lights[1].direction);
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

TEST(CutFacesModule, TakesToolOrBase) {
  const auto show = [](const std::string& argument) {
    const Model model = model_of("cut_faces(" + argument + ") cube();");
    return std::get<CutFacesAttribute>(model.graph[model.graph.root].content).show;
  };
  EXPECT_EQ(show("\"base\""), CutFaces::base);
  EXPECT_EQ(show("show = \"tool\""), CutFaces::tool);
  EXPECT_NE(error_of("cut_faces(\"bas\") cube();").find("scene.scad:1:11: error: 'show' must be"), std::string::npos);
  EXPECT_NE(error_of("cut_faces() cube();").find("'show' must be"), std::string::npos);
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

TEST(View, ALensHasADiameterOrAStopAndAFocus) {
  const auto camera = [](const std::string& arguments) {
    return *model_of("camera(from = [0, -100, 0], at = [0, 0, 0], " + arguments + "); cube();").camera;
  };
  EXPECT_EQ(camera("fov = 30").aperture, 0);
  EXPECT_EQ(camera("aperture = 3").aperture, 3);
  EXPECT_EQ(camera("aperture = 3").focus, std::nullopt);
  EXPECT_EQ(camera("aperture = 3, focus = 70").focus, 70);
  EXPECT_DOUBLE_EQ(*camera("aperture = 3, focus = [40, -20, 9]").focus, 80) << "along the view";
  // A lens of 50 mm on film 36 wide, at f/2.
  EXPECT_NEAR(camera("fov = 2 * atan(18 / 50), fstop = 2").aperture, 25, 1e-12);
  const Camera scaled =
      *model_of("scale(2) { camera(from = [0, -10, 0], at = [0, 0, 0], aperture = 1, focus = 5); cube(); }").camera;
  EXPECT_DOUBLE_EQ(scaled.aperture, 2);
  EXPECT_DOUBLE_EQ(*scaled.focus, 10);
  EXPECT_NE(error_of("camera(aperture = 1, fstop = 2);").find("one of the two"), std::string::npos);
  EXPECT_NE(error_of("camera(orthographic = 9, aperture = 1);").find("parallel rays"), std::string::npos);
  EXPECT_NE(error_of("camera(focus = [99, -99, 99]);").find("in front"), std::string::npos);
  EXPECT_NE(error_of("camera(fstop = 0);").find("above 0"), std::string::npos);
}

TEST(View, SectionsTakeSidesAwayAndMoveWithTheTransformsAroundThem) {
  const auto section = [](const std::string& text) { return model_of(text + " cube();").section; };
  EXPECT_EQ(section("section();"), (std::vector<SectionCut>{{{{{0, -1, 0}, std::nullopt}}}}));
  EXPECT_EQ(section("section([1, 0, 0], 5);"), (std::vector<SectionCut>{{{{{1, 0, 0}, 5}}}}));
  EXPECT_EQ(section("section([1, 0, 0], 5); section([0, 1, 0]);").size(), 2u);
  EXPECT_EQ(section("section(planes = [[1, 0, 0, 5], [0, 1, 0]]);"),
            (std::vector<SectionCut>{{{{{1, 0, 0}, 5}, {{0, 1, 0}, std::nullopt}}}}));
  // The same plane, whatever the length of its normal has become: x > 2 turned to y > 2, moved by 3, twice as large.
  const SectionPlane moved = section("scale(2) translate([0, 3, 0]) rotate(90) section([1, 0, 0], 2);")[0].planes[0];
  EXPECT_NEAR(moved.normal.x, 0, 1e-15);
  EXPECT_GT(moved.normal.y, 0);
  EXPECT_DOUBLE_EQ(*moved.d / moved.normal.y, 10);
  EXPECT_NE(error_of("section([0, 0, 0], 1);").find("not be zero"), std::string::npos);
  EXPECT_NE(error_of("section([1, 0, 0]) cube();").find("takes no children"), std::string::npos);
  EXPECT_NE(error_of("camera() sphere();").find("takes no children"), std::string::npos);
  EXPECT_NE(error_of("light() { cube(); }").find("takes no children"), std::string::npos);
  EXPECT_NE(error_of("section(planes = [[1, 0]]);").find("list of planes"), std::string::npos);
  EXPECT_NE(error_of("section(planes = []);").find("list of planes"), std::string::npos);
  EXPECT_NE(error_of("section([1, 0, 0], planes = [[1, 0, 0, 2]]);").find("one of the two"), std::string::npos);
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
