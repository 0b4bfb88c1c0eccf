#include "mesh/height_map.h"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>

#include "mesh/build_mesh.h"

namespace tenon {
namespace {

TriangleMesh mesh_of(const std::string& bytes, const HeightMapOptions& options = {}) {
  const auto soup = read_height_map({"map", bytes}, options);
  EXPECT_TRUE(soup) << format_error(soup.error());
  auto built = build_mesh(*soup, "the surface", false);
  EXPECT_TRUE(built) << format_error(built.error());
  return std::move(built->mesh);
}

std::string error_of(const std::string& bytes) {
  const auto soup = read_height_map({"map", bytes}, {});
  return soup ? "none" : format_error(soup.error());
}

// The height at a vertex: the largest z there.
double height(const TriangleMesh& mesh, double x, double y) {
  double z = -1e9;
  for (const Vec3& v : mesh.vertices) {
    if (v.x == x && v.y == y) z = std::max(z, v.z);
  }
  return z;
}
double bottom(const TriangleMesh& mesh) {
  double z = 1e9;
  for (const Vec3& v : mesh.vertices) z = std::min(z, v.z);
  return z;
}

std::string png(png_uint_32 width, png_uint_32 height, png_uint_32 format, const std::vector<png_byte>& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = format;
  std::string bytes(4096, '\0');
  png_alloc_size_t size = bytes.size();
  EXPECT_NE(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr), 0);
  bytes.resize(size);
  return bytes;
}

// Every figure as OpenSCAD 2021.01 has it in what it exports.
TEST(HeightMap, TextIsReadAsOpenScadReadsIt) {
  const auto mesh = mesh_of("# comment\n1 2 3\n4 5 9\n\n7 8 -6 \n");
  EXPECT_EQ(height(mesh, 0, 0), 1);
  EXPECT_EQ(height(mesh, 2, 0), 3);
  EXPECT_EQ(height(mesh, 2, 2), -6);
  EXPECT_EQ(height(mesh, 1.5, 0.5), 4.75);
  EXPECT_EQ(bottom(mesh), -7);
  const auto ragged = mesh_of("1 2 3\n3\n5 6 7 8\n", {true, false});
  EXPECT_EQ(height(ragged, -1.5, 0), 3);
  EXPECT_EQ(height(ragged, -0.5, 0), 0) << "what is missing is 0";
  EXPECT_EQ(height(ragged, 1.5, 1), 8);
  EXPECT_EQ(bottom(ragged), 0) << "no lower than 0 while all heights are 1 and more";
}

TEST(HeightMap, PicturesAreReadAsOpenScadReadsThem) {
  const std::string rgb =
      png(3, 2, PNG_FORMAT_RGB, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 10, 20, 30, 0, 0, 0});
  const auto mesh = mesh_of(rgb);
  EXPECT_NEAR(height(mesh, 0, 1), 21.26, 1e-12) << "the top row is the farthest";
  EXPECT_NEAR(height(mesh, 1, 1), 71.52, 1e-12);
  EXPECT_NEAR(height(mesh, 0, 0), 100, 1e-12);
  EXPECT_NEAR(height(mesh, 1, 0), 7.29255, 5e-6);
  EXPECT_EQ(bottom(mesh), -1);
  const auto inverted = mesh_of(rgb, {false, true});
  EXPECT_NEAR(height(inverted, 0, 0), -99.6078, 5e-5);
  EXPECT_NEAR(height(inverted, 2, 0), 0.392157, 5e-7);
  EXPECT_NEAR(bottom(inverted), -100.608, 5e-4);
  const auto gray = mesh_of(png(2, 2, PNG_FORMAT_GRAY, {255, 128, 0, 50}));
  EXPECT_NEAR(height(gray, 1, 1), 50.1961, 5e-5);
  EXPECT_NEAR(height(gray, 1, 0), 19.6078, 5e-5);
}

TEST(HeightMap, WhatIsWrongIsSaid) {
  EXPECT_NE(error_of("1 2\n3 x\n").find("map:2:3: error: 'x' is no finite number"), std::string::npos);
  EXPECT_NE(error_of("1 2\n").find("at least two rows and two columns, not 1 and 2"), std::string::npos);
  EXPECT_NE(error_of("").find("not 0 and 0"), std::string::npos);
  std::string picture = png(2, 2, PNG_FORMAT_GRAY, {255, 128, 0, 50});
  EXPECT_NE(error_of(picture.substr(0, 50)).find("cut off"), std::string::npos) << error_of(picture.substr(0, 50));
  picture[picture.find("IDAT") + 8] ^= 1;
  EXPECT_NE(error_of(picture).find("cannot be read"), std::string::npos) << error_of(picture);
  EXPECT_NE(error_of("\x89PNG").find("cut off"), std::string::npos);
}

}  // namespace
}  // namespace tenon
