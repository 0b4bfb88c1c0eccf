#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "film/random_film.h"
#include "tenon/film/film_part.h"
#include "tenon/image/picture_file.h"

namespace tenon {
namespace {

constexpr int width = 23, height = 17;
constexpr std::uint32_t samples = 9;

FilmPart part_of(const SampleBox& box, const Layers& layers) {
  FilmPart part;
  Layers planes = layers;
  planes.remove(Layer::samples).remove(Layer::sums);
  part.film = Film(width, height, box.window, planes);
  take(part.film, box.first, box.end);
  part.layers = layers;
  part.bits = 32;
  part.samples = samples;
  part.done = {box};
  part.notes = {{"Software", "tenon"}, {"Scene", "1234"}};
  return part;
}

// Cuts a box in two at a random place, again and again.
std::vector<SampleBox> random_partition(Random& random, int cuts) {
  std::vector<SampleBox> boxes{{{0, 0, width, height}, 0, samples}};
  for (int i = 0; i < cuts; ++i) {
    const std::size_t which = random.bits() % boxes.size();
    SampleBox low = boxes[which], high = low;
    const int way = random.below(3);
    if (way == 0 && low.window.width() > 1) {
      low.window.x1 = high.window.x0 = low.window.x0 + 1 + random.below(low.window.width() - 1);
    } else if (way == 1 && low.window.height() > 1) {
      low.window.y1 = high.window.y0 = low.window.y0 + 1 + random.below(low.window.height() - 1);
    } else if (way == 2 && low.end - low.first > 1) {
      low.end = high.first =
          low.first + 1 + static_cast<std::uint32_t>(random.below(static_cast<int>(low.end - low.first) - 1));
    } else {
      continue;
    }
    boxes[which] = low;
    boxes.push_back(high);
  }
  return boxes;
}

std::string bytes(const FilmPart& part) {
  const auto encoded = encode_exr(part_picture(part));
  EXPECT_TRUE(encoded.ok());
  return *encoded;
}

// Through the file and back.
FilmPart stored(const FilmPart& part) {
  const auto picture = decode_exr(bytes(part), "part.exr");
  EXPECT_TRUE(picture.ok());
  auto read = read_part(*picture, "part.exr");
  EXPECT_TRUE(read.ok()) << read.error().message;
  return std::move(*read);
}

std::vector<std::string> names_of(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(std::to_string(i) + ".exr");
  return names;
}

TEST(Merge, AnyPartitionInAnyOrderGivesTheSingleRunsBytes) {
  const std::uint64_t seed = 20;
  SCOPED_TRACE(seed);
  Random random(seed);
  Layers layers = all_planes();
  layers.add(Layer::samples);
  const std::string expected = bytes(part_of({{0, 0, width, height}, 0, samples}, layers));
  for (int round = 0; round < 12; ++round) {
    std::vector<FilmPart> parts;
    for (const SampleBox& box : random_partition(random, 1 + 2 * round)) parts.push_back(stored(part_of(box, layers)));
    for (std::size_t i = parts.size(); i-- > 1;) std::swap(parts[i], parts[random.bits() % (i + 1)]);
    // Some are merged on the way, and stored again.
    while (parts.size() > 3 && random.chance(0.5)) {
      const auto two = merge({parts[0], parts[1]}, names_of(2));
      ASSERT_TRUE(two.ok()) << two.error().message;
      parts.erase(parts.begin(), parts.begin() + 2);
      parts.push_back(stored(*two));
    }
    const auto all = merge(parts, names_of(parts.size()));
    ASSERT_TRUE(all.ok()) << all.error().message;
    EXPECT_TRUE(all->is_complete());
    EXPECT_EQ(bytes(*all), expected) << parts.size() << " parts, round " << round;
  }
}

TEST(Merge, PartThatIsNotAllKeepsItsSums) {
  const SampleBox left{{0, 0, 10, height}, 0, samples}, right{{10, 0, width, height}, 0, samples};
  const SampleBox late{{0, 0, 10, height}, 4, samples}, early{{0, 0, 10, height}, 0, 4};
  const auto some = merge({part_of(right, {}), part_of(late, {})}, names_of(2));
  ASSERT_TRUE(some.ok());
  EXPECT_FALSE(some->is_complete());
  EXPECT_NEAR(some->share(), 1 - 10.0 * 4 / (width * samples), 1e-12);
  const auto all = merge({stored(*some), part_of(early, {})}, names_of(2));
  ASSERT_TRUE(all.ok());
  EXPECT_EQ(bytes(*all), bytes(*merge({part_of(left, {}), part_of(right, {})}, names_of(2))));
}

TEST(Merge, SameSamplesTwiceAreRefused) {
  const SampleBox a{{0, 0, 10, height}, 0, 4}, b{{9, 5, width, 6}, 3, samples}, c{{9, 5, width, 6}, 4, samples};
  const auto twice = merge({part_of(c, {}), part_of(a, {}), part_of(b, {})}, names_of(3));
  ASSERT_FALSE(twice.ok());
  EXPECT_NE(twice.error().message.find("hold the same samples"), std::string::npos) << twice.error().message;
  EXPECT_TRUE(merge({part_of(a, {}), part_of(c, {})}, names_of(2)).ok());
}

TEST(Merge, PartsOfOtherPicturesAreRefusedWithTheDifference) {
  const SampleBox a{{0, 0, width, height}, 0, 4}, b{{0, 0, width, height}, 4, samples};
  FilmPart other = part_of(b, {});
  other.notes[1].text = "5678";
  const auto merged = merge({part_of(a, {}), other}, names_of(2));
  ASSERT_FALSE(merged.ok());
  EXPECT_EQ(merged.error().kind, ErrorKind::input);
  EXPECT_NE(merged.error().message.find("'1.exr'"), std::string::npos) << merged.error().message;
  EXPECT_NE(merged.error().message.find("Scene '5678', not '1234'"), std::string::npos) << merged.error().message;
  EXPECT_FALSE(merge({part_of(a, {}), part_of(b, Layers{Layer::normal})}, names_of(2)).ok());
}

TEST(Part, DamagedOnesAreRefused) {
  const Picture whole = part_picture(part_of({{2, 3, 9, 9}, 1, 4}, all_planes()));
  EXPECT_TRUE(read_part(whole, "x").ok());
  for (std::size_t i = 0; i < whole.channels.size(); ++i) {
    if (whole.channels[i].name.rfind("sums.", 0) != 0 || whole.channels[i].name.find("first") != std::string::npos)
      continue;
    Picture lacking = whole;
    lacking.channels.erase(lacking.channels.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(read_part(lacking, "x").ok()) << whole.channels[i].name;
  }
  for (const char* done :
       {"2,3,9,9,1", "2,3,10,9,1,4", "9,3,2,9,1,4", "2,3,9,9,4,1", "2,3,9,9,1,99", "x", "2,3,9,9,1,4 ,"}) {
    Picture wrong = whole;
    for (PictureNote& note : wrong.notes) {
      if (note.key == "samplesDone") note.text = done;
    }
    EXPECT_FALSE(read_part(wrong, "x").ok()) << done;
  }
  Picture plain = whole;
  plain.notes.clear();
  const auto refused = read_part(plain, "plain.exr");
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("--layers sums"), std::string::npos);
}

TEST(Joined, BoxesThatFillABoxAreOne) {
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(joined(random_partition(random, i)), (std::vector<SampleBox>{{{0, 0, width, height}, 0, samples}}));
  }
}

}  // namespace
}  // namespace tenon
