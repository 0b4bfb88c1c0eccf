#include <algorithm>
#include <cmath>

#include "apps/program_test.h"
#include "tenon/image/picture_file.h"

namespace tenon {
namespace {

using Words = std::vector<std::string>;

// Where light bounces: almost all of it is noise. kd below 1 is a warning, and meant.
const char* const room = R"(
  camera(from = [0, -14, 0], at = [0, 0, 0], fov = 40);
  light(type = "point", position = [0, -1, 3.5], intensity = 0.9);
  ambient(0);
  background([0, 0, 0]);
  material("wall", kd = 0.9, ks = 0) {
    difference() { cube([10, 10, 9], center = true); translate([0, -1, 0]) cube([8, 10, 8], center = true); }
    translate([-1.5, 0.5, -2.8]) sphere(1.2);
  }
  material("red", kd = 0.9, ks = 0, color = [0.9, 0.2, 0.1])
    translate([1.5, 1, -2.5]) rotate([0, 0, 30]) cube([2, 2, 3], center = true);
)";
// Many edges, three lights of different colours and their shadows.
const char* const columns = R"(
  camera(from = [6, -12, 7], at = [0, 0, 1], fov = 40);
  light(type = "point", position = [8, -6, 10], intensity = 0.7);
  light(type = "point", position = [-9, -8, 5], intensity = 0.5, color = [0.6, 0.7, 1]);
  light(type = "point", position = [0, 9, 9], intensity = 0.5, color = [1, 0.8, 0.5]);
  ambient(0.4);
  background([0.8, 0.9, 1]);
  material("stone", kd = 0.8, ks = 0, color = [0.9, 0.85, 0.7]) difference() {
    for (x = [-3 : 2 : 3], y = [-2 : 2 : 2]) translate([x, y, 0]) cylinder(h = 3 + y / 4, r = 0.6);
    translate([0, 0, 3]) sphere(2);
  }
  material("floor", kd = 0.8, ks = 0) translate([-8, -8, -1]) cube([16, 16, 1]);
)";
// Curved all over, inside and out.
const char* const bowl = R"(
  camera(from = [4, -9, 8], at = [0, 0, 0.3], fov = 35);
  light(type = "point", position = [6, -4, 9], intensity = 0.9);
  light(type = "point", position = [-8, -5, 6], intensity = 0.4);
  ambient(0.5);
  background([0.5, 0.7, 0.9]);
  material("clay", kd = 0.85, ks = 0, color = [0.85, 0.5, 0.3]) difference() {
    translate([0, 0, 1]) sphere(2);
    translate([0, 0, 1.6]) sphere(1.9);
    translate([-3, -3, 2]) cube(6);
  }
  material("floor", kd = 0.8, ks = 0, color = [0.7, 0.75, 0.8]) translate([-6, -6, -1.5]) cube([12, 12, 0.5]);
)";

// Most of what is seen is seen in glass and mirrors, of which no layer tells.
const char* const glass = R"(
  camera(from = [0, -12, 4], at = [0, 0, 0.6], fov = 35);
  light(type = "sphere", position = [5, -6, 9], radius = 1, intensity = 40);
  ambient(0.5);
  background([0.4, 0.6, 0.9]);
  material("tiles", model = "lambert", color = [0.9, 0.3, 0.2], texture = "checker", texture_color = [0.9, 0.9, 0.8])
    translate([-9, -9, -1.2]) cube([18, 18, 0.2]);
  material("glass") difference() { sphere(1.6); translate([0.4, -0.4, 0.5]) sphere(0.9); }
  material("mirror") translate([-3, 2, 0.8]) rotate([0, 0, 25]) cube([0.4, 4, 4], center = true);
  material("blue", model = "lambert", color = [0.2, 0.3, 0.8]) translate([2.6, 1, -0.2]) sphere(0.8);
)";

class DenoiseCommand : public ProgramTest {
 protected:
  void render(const Words& more) const {
    Words words{"render", "scene.scad", "-q", "--size", "48x36", "--integrator", "path"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
  Picture picture(const std::string& name) const {
    const auto read = decode_exr(this->read(name), name);
    EXPECT_TRUE(read.ok()) << name;
    return *read;
  }
};

/// How much more one picture errs than another, squared errors added up.
struct Lead {
  double value = 0;
  double spread = 0;  ///< its standard error
};

// A picture of other samples errs independently of both, so by the difference of its squared distances from them it
// tells, without bias, which of them errs more; its own error is in that difference only by its product with what
// differs between them.
Lead lead(const Picture& better, const Picture& worse, const Picture& other) {
  double value = 0, variance = 0;
  for (const std::string channel : {"R", "G", "B"}) {
    const auto &a = worse.find(channel)->values, &b = better.find(channel)->values, &c = other.find(channel)->values;
    const auto& c_error = other.find("error." + channel)->values;
    for (std::size_t i = 0; i < a.size(); ++i) {
      value += std::pow(a[i] - c[i], 2) - std::pow(b[i] - c[i], 2);
      // The three components of a pixel err together: three times their sum is no less than the square of the sum.
      variance += 3 * 4 * std::pow((b[i] - a[i]) * c_error[i], 2);
    }
  }
  return {value, std::sqrt(variance)};
}

// The mean over the squares of so many pixels around each, as far as they lie in the picture.
Picture blurred(Picture picture, int reach) {
  const int width = picture.width, height = picture.height;
  for (PictureChannel& channel : picture.channels) {
    if (channel.name != "R" && channel.name != "G" && channel.name != "B") continue;
    const std::vector<float> before = channel.values;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        float sum = 0, count = 0;
        for (int qy = std::max(0, y - reach); qy <= std::min(height - 1, y + reach); ++qy) {
          for (int qx = std::max(0, x - reach); qx <= std::min(width - 1, x + reach); ++qx) {
            sum += before[static_cast<std::size_t>(qy * width + qx)], ++count;
          }
        }
        channel.values[static_cast<std::size_t>(y * width + x)] = sum / count;
      }
    }
  }
  return picture;
}

// Denoising errs less than the noisy picture (a reach of 0) and than any blur of it that knows nothing of edges, by two
// standard errors of what is measured. Of what is seen in glass no layer tells, and the rare bright samples there,
// which eight samples know nothing of, stay where they are: a blur spreads them, and errs less.
TEST_F(DenoiseCommand, ErrorFalls) {
  const std::vector<std::pair<const char*, int>> scenes{{room, 3}, {columns, 3}, {bowl, 3}, {glass, 0}};
  for (const auto& [text, longest_reach] : scenes) {
    write("scene.scad", text);
    render({"--spp", "256", "--seed", "1", "--layers", "variance", "--bits", "32", "-o", "other.exr"});
    for (const std::string samples : {"8", "64", "256"}) {
      render({"--spp", samples, "--bits", "32", "-o", "noisy.exr"});
      ASSERT_EQ(run({"denoise", "noisy.exr", "-q", "-o", "denoised.exr"}).status, 0);
      for (int reach = 0; reach <= longest_reach; ++reach) {
        const Lead ahead = lead(picture("denoised.exr"), blurred(picture("noisy.exr"), reach), picture("other.exr"));
        EXPECT_GT(ahead.value, 2 * ahead.spread) << samples << " samples, blurred by " << reach << " of" << text;
      }
    }
  }
}

TEST_F(DenoiseCommand, SameAsDenoisingOnTheWayAndKeepsTheOtherChannels) {
  write("scene.scad", room);
  render({"--spp", "4", "-o", "noisy.exr", "--bits", "32"});
  render({"--spp", "4", "-o", "way.exr", "--bits", "32", "--denoise"});
  render({"--spp", "4", "-o", "way.png", "--denoise"});
  ASSERT_EQ(run({"denoise", "noisy.exr", "-q", "-o", "after.png"}).status, 0);
  ASSERT_EQ(run({"denoise", "-", "-q", "-o", "after.exr"}, read("noisy.exr")).status, 0);
  const Picture noisy = picture("noisy.exr"), way = picture("way.exr"), after = picture("after.exr");
  for (const PictureChannel& channel : noisy.channels) {
    const bool is_colour = channel.name == "R" || channel.name == "G" || channel.name == "B";
    EXPECT_EQ(*after.find(channel.name) == channel, !is_colour) << channel.name;
    ASSERT_EQ(after.find(channel.name)->values.size(), way.find(channel.name)->values.size());
    // Layers are read back as halves.
    for (std::size_t i = 0; i < channel.values.size() && is_colour; ++i) {
      EXPECT_NEAR(after.find(channel.name)->values[i], way.find(channel.name)->values[i], 0.02);
    }
  }
  EXPECT_EQ(read("way.png").substr(0, 4), "\x89PNG");
  EXPECT_EQ(read("after.png").substr(0, 4), "\x89PNG");
}

TEST_F(DenoiseCommand, PictureWithoutLayersIsRefused) {
  write("scene.scad", "sphere(1);");
  render({"--spp", "2", "-o", "plain.exr", "--layers", "none"});
  const Outcome outcome = run({"denoise", "plain.exr", "-o", "x.png"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.err, "'plain.exr' has no channel Z")) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
}

}  // namespace
}  // namespace tenon
