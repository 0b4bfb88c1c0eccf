#include <gtest/gtest.h>

#include "mesh/polygon_soup.h"
#include "mesh/zip_bytes.h"

namespace tenon {
namespace {

const std::string tetrahedron =
    "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>"
    "<vertex x='0' y='0' z='1'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/><triangle v1='0' v2='1' v3='3'/>"
    "<triangle v1='0' v2='3' v3='2'/><triangle v1='1' v2='2' v3='3'/></triangles></mesh>";

std::string model(const std::string& objects, const std::string& items) {
  return "<model unit='millimeter'><resources>" + objects + "</resources><build>" + items + "</build></model>";
}
std::string with_model(const std::string& text) {
  return zip_of({{"3D/3dmodel.model", text}});
}
std::string error_of(const std::string& bytes) {
  const auto soup = read_3mf({"a.3mf", bytes});
  return soup ? "none" : soup.error().message;
}
void expect_error(const std::string& bytes, const std::string& part) {
  EXPECT_NE(error_of(bytes).find(part), std::string::npos) << error_of(bytes) << ", not " << part;
}

TEST(ThreeMf, ItemsAndComponentsStandWhereTheyArePlaced) {
  const auto soup = read_3mf(
      {"a.3mf",
       with_model(model("<object id='1'>" + tetrahedron +
                            "</object><object id='2'><components><component objectid='1'/>"
                            "<component objectid='1' transform='-1 0 0 0 1 0 0 0 1 5 0 0'/></components></object>",
                        "<item objectid='2' transform='2 0 0 0 2 0 0 0 2 0 0 1'/>"))});
  ASSERT_TRUE(soup) << soup.error().message;
  ASSERT_EQ(soup->face_count(), 8u);
  EXPECT_EQ(soup->points[1], (Vec3{2, 0, 1}));
  EXPECT_EQ(soup->points[5], (Vec3{8, 0, 1}));
  // The mirrored one still faces outward.
  double volume = 0;
  for (std::size_t f = 4; f < 8; ++f) {
    const auto corners = soup->face(f);
    volume += dot(soup->points[corners[0]], cross(soup->points[corners[1]], soup->points[corners[2]])) / 6;
  }
  EXPECT_NEAR(volume, 8.0 / 6, 1e-12);
}

TEST(ThreeMf, TheModelIsTheOneThatThePackageNames) {
  const std::string relations =
      "<Relationships><Relationship Target='/parts/it.model' Id='r' "
      "Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>";
  const std::string whole = model("<object id='7'>" + tetrahedron + "</object>", "<item objectid='7'/>");
  const auto soup = read_3mf({"a.3mf", zip_of({{"_rels/.rels", relations}, {"parts/it.model", whole}})});
  ASSERT_TRUE(soup) << soup.error().message;
  EXPECT_EQ(soup->face_count(), 4u);
}

TEST(ThreeMf, WhatIsWrongIsSaid) {
  expect_error("", "the part '3D/3dmodel.model' is missing");
  expect_error("PK\3\4 and no more", "no ZIP archive");
  expect_error(zip_of({{"else", "text"}}), "the part '3D/3dmodel.model' is missing");
  expect_error(with_model("<model><resources>"), "is no XML");
  expect_error(with_model("<html/>"), "has no <model>");
  expect_error(with_model(model("<object id='1'>" + tetrahedron + "</object>", "")), "builds no triangles");
  expect_error(with_model(model("", "<item objectid='9'/>")), "places object '9', which it does not have");
  expect_error(
      with_model(model("<object id='1'>" + tetrahedron + "</object>", "<item objectid='1' transform='1 2 3'/>")),
      "is not twelve finite numbers");
  std::string bad = tetrahedron;
  bad.replace(bad.find("x='1'"), 5, "x='nan'");
  expect_error(with_model(model("<object id='1'>" + bad + "</object>", "<item objectid='1'/>")),
               "vertex 1 of object '1' in the 3MF file needs x, y and z");
  bad = tetrahedron;
  bad.replace(bad.find("v3='3'"), 6, "v3='4'");
  expect_error(with_model(model("<object id='1'>" + bad + "</object>", "<item objectid='1'/>")),
               "triangle 1 of object '1' in the 3MF file needs v1, v2 and v3, numbers from 0 to 4 - 1");
  std::string damaged = with_model(model("<object id='1'>" + tetrahedron + "</object>", "<item objectid='1'/>"));
  damaged[60] = static_cast<char>(damaged[60] ^ 0x55);
  EXPECT_NE(error_of(damaged), "none");
}

// A few bytes that mean more than any machine holds.
TEST(ThreeMf, ReferencesThatMultiplyEnd) {
  std::string objects = "<object id='0'>" + tetrahedron + "</object>";
  for (int i = 1; i <= 20; ++i) {
    const std::string part = "<component objectid='" + std::to_string(i - 1) + "'/>";
    objects += "<object id='" + std::to_string(i) + "'><components>";
    for (int k = 0; k < 10; ++k) objects += part;
    objects += "</components></object>";
  }
  const std::string itself = "<object id='a'><components><component objectid='a'/></components></object>";
  expect_error(with_model(model(itself, "<item objectid='a'/>")), "may contain itself");
  EXPECT_EQ(read_3mf({"a.3mf", with_model(model(objects, "<item objectid='3'/>"))})->face_count(), 4000u);
}

}  // namespace
}  // namespace tenon
