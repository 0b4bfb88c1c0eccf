#include <gtest/gtest.h>

#include "mesh/polygon_soup.h"
#include "mesh/zip_bytes.h"

namespace tenon {
namespace {

std::string vertex(const char* x, const char* y, const char* z) {
  return std::string("<vertex><coordinates><x>") + x + "</x><y> " + y + "\n</y><z>" + z + "</z></coordinates></vertex>";
}
std::string triangle(const char* a, const char* b, const char* c) {
  return std::string("<triangle><v1>") + a + "</v1><v2>" + b + "</v2><v3>" + c + "</v3></triangle>";
}

// Its triangles are in two volumes.
const std::string tetrahedron = "<mesh><vertices>" + vertex("0", "0", "0") + vertex("1", "0", "0") +
                                vertex("0", "1", "0") + vertex("0", "0", "1") + "</vertices><volume>" +
                                triangle("0", "2", "1") + triangle("0", "1", "3") + "</volume><volume>" +
                                triangle("0", "3", "2") + triangle("1", "2", "3") + "</volume></mesh>";

std::string amf(const std::string& parts) {
  return "<?xml version='1.0'?><amf unit='inch'><metadata type='name'>it</metadata>" + parts + "</amf>";
}
std::string object(const std::string& id, const std::string& mesh = tetrahedron) {
  return "<object id='" + id + "'><color><r>1</r></color>" + mesh + "</object>";
}
std::string error_of(const std::string& bytes) {
  const auto soup = read_amf({"a.amf", bytes});
  return soup ? "none" : soup.error().message;
}
void expect_error(const std::string& bytes, const std::string& part) {
  EXPECT_NE(error_of(bytes).find(part), std::string::npos) << error_of(bytes) << ", not " << part;
}

TEST(Amf, ObjectsStandWhereTheyAreUnlessConstellationsPlaceThem) {
  const auto alone = read_amf({"a.amf", amf(object("1") + object("2"))});
  ASSERT_TRUE(alone) << alone.error().message;
  EXPECT_EQ(alone->face_count(), 8u);
  EXPECT_EQ(alone->points[5], (Vec3{1, 0, 0}));

  const std::string inner =
      "<constellation id='in'><instance objectid='1'><deltax>5</deltax><rz>90</rz></instance></constellation>";
  const std::string outer =
      "<constellation id='out'><instance objectid='in'><deltaz>2</deltaz></instance>"
      "<instance objectid='in'><deltaz>3</deltaz><rx>90</rx></instance></constellation>";
  const auto placed = read_amf({"a.amf", amf(outer + inner + object("1") + object("2"))});
  ASSERT_TRUE(placed) << placed.error().message;
  // That which no constellation has, and the other one twice.
  EXPECT_EQ(placed->face_count(), 12u);
  const auto has = [&](const Vec3& p) {
    return std::any_of(placed->points.begin(), placed->points.end(),
                       [&](const Vec3& q) { return length(p - q) < 1e-12; });
  };
  EXPECT_TRUE(has({1, 0, 0}));
  EXPECT_TRUE(has({5, 1, 2}));
  EXPECT_TRUE(has({5, 0, 4}));
}

TEST(Amf, MayBePacked) {
  const auto soup = read_amf({"a.amf", zip_of({{"part.amf", amf(object("1"))}})});
  ASSERT_TRUE(soup) << soup.error().message;
  EXPECT_EQ(soup->face_count(), 4u);
}

TEST(Amf, WhatIsWrongIsSaid) {
  expect_error("", "is no XML");
  expect_error("<html/>", "has no <amf>");
  expect_error("PK\3\4 and no more", "packed, and damaged");
  expect_error(amf(""), "has no triangles");
  expect_error(amf(object("1") + "<constellation id='c'><instance objectid='9'/></constellation>"),
               "places object '9', which it does not have");
  expect_error(amf(object("1") + "<constellation id='c'><instance objectid='1'><rx>up</rx></instance></constellation>"),
               "an instance in constellation 'c' of the AMF file has a place that is no number");
  std::string bad = tetrahedron;
  bad.replace(bad.find("<x>1"), 4, "<x>a");
  expect_error(amf(object("1", bad)), "vertex 1 of object '1' in the AMF file needs coordinates x, y and z");
  bad = tetrahedron;
  bad.replace(bad.find("<v3>3"), 5, "<v3>4");
  expect_error(amf(object("1", bad)),
               "triangle 1 of object '1' in the AMF file needs v1, v2 and v3, numbers from 0 to 4");
}

TEST(Amf, ConstellationsMayHoldOneAnotherButNotThemselves) {
  std::string parts = object("0");
  for (int i = 1; i <= 3; ++i) {
    parts += "<constellation id='" + std::to_string(i) + "'>";
    for (int k = 0; k < 10; ++k) parts += "<instance objectid='" + std::to_string(i - 1) + "'/>";
    parts += "</constellation>";
  }
  EXPECT_EQ(read_amf({"a.amf", amf(parts)})->face_count(), 4000u);
  const std::string b = "<constellation id='b'><instance objectid='b'/></constellation>";
  expect_error(amf(object("1") + b), "'b' is within one that holds itself");
  expect_error(amf(b + "<constellation id='a'><instance objectid='b'/></constellation>"),
               "'b' is within one that holds itself");
}

}  // namespace
}  // namespace tenon
