#include "rays/judged_places.h"

#include "rays/winding_number.h"
#include "support/meshes.h"
#include "support/scene_builder.h"

// What `./dev bench bunny` asks of the Stanford bunny, of a mesh that is made here.
namespace tenon::bench {
namespace {

using fixtures::SceneBuilder;

TriangleMesh bumpy_ball(int levels) {
  return meshes::star(levels, [](const Vec3& d) { return 1 + 0.3 * d.x * d.y + 0.2 * d.z * d.z * d.x; });
}

CsgTree cut_ball(const std::string& cut, MeshStructure local, double shift) {
  SceneBuilder b;
  TriangleMesh mesh = bumpy_ball(4);
  mesh.local = local;
  const SceneNodeId ball = b.primitive("mesh", {meshes::share(mesh), false});
  if (cut == "minus shifted") return b.tree(b.subtract({ball, b.translate({shift, 0.3 * shift, -shift}, ball)}));
  if (cut == "and box") {
    return b.tree(b.intersect({ball, b.translate({shift, 0, 0}, b.rotate({20, 30, 40}, b.cube({1, 1.2, 1.4}, true)))}));
  }
  std::vector<SceneNodeId> parts{ball};
  for (int i = 0; i < 20; ++i) {
    parts.push_back(b.translate({std::sin(73 * i) + shift, std::cos(41 * i), std::sin(29 * i)}, b.sphere(0.3)));
  }
  return b.tree(b.subtract(parts));
}

JudgedPlaces judge(const CsgTree& tree, const CsgTree& traced, std::size_t rays) {
  const auto accelerator = build_accelerator("cells", traced);
  EXPECT_TRUE(accelerator.ok());
  const Result<JudgedPlaces> judged = judge_places(tree, **accelerator, rays);
  EXPECT_TRUE(judged.ok());
  return *judged;
}

TEST(WindingNumber, IsOneInsideAndNoneOutside) {
  const WindingNumber winding(bumpy_ball(3));
  EXPECT_NEAR(winding.at({0.1, 0.2, 0.3}), 1, 1e-12);
  EXPECT_NEAR(winding.at({1.5, 0.2, 0.3}), 0, 1e-12);
  EXPECT_NEAR(winding.at({0.9, 0.9, 0.9}), 0, 1e-12);
}

TEST(JudgedPlaces, BooleansOfMeshesHaveNoneWrong) {
  for (const char* cut : {"minus spheres", "minus shifted", "and box"}) {
    for (const MeshStructure local : {MeshStructure::bvh, MeshStructure::kd}) {
      const CsgTree tree = cut_ball(cut, local, 0.1);
      const JudgedPlaces judged = judge(tree, tree, 20'000);
      EXPECT_GT(judged.met, 5'000U) << cut;
      EXPECT_GT(judged.places, 30'000U) << cut;
      EXPECT_EQ(judged.wrong, 0U) << cut;
    }
  }
}

TEST(JudgedPlaces, FindsWhatIsWrong) {
  for (const char* cut : {"minus spheres", "minus shifted", "and box"}) {
    const CsgTree tree = cut_ball(cut, MeshStructure::bvh, 0.1), other = cut_ball(cut, MeshStructure::bvh, 0.11);
    EXPECT_GT(judge(tree, other, 20'000).wrong, 0U) << cut;
  }
}

}  // namespace
}  // namespace tenon::bench
