#include "rays/sampled_race.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace tenon::bench {
namespace {

constexpr std::size_t blocks = 600;

RaySet numbered_rays() {
  RaySet set;
  set.rays.resize(blocks * Tracer::block);
  for (std::size_t i = 0; i < set.rays.size(); ++i) set.rays[i].ray.origin.x = static_cast<double>(i + 1);
  return set;
}

// Says of each ray the number that it was given, times a factor; takes so many CPU seconds a block at least.
class NumberTracer final : public Tracer {
 public:
  NumberTracer(double factor, double seconds) : Tracer("numbers"), factor_(factor), seconds_(seconds) {}

  void load(const RaySet& set, int) override {
    rays_ = set.rays;
    answers_.assign(rays_.size(), {});
    most_loaded_ = std::max(most_loaded_, rays_.size());
  }
  void trace(std::size_t begin, std::size_t end, int) override {
    const double begun = thread_cpu_seconds();
    for (std::size_t i = begin; i < end; ++i) answers_[i] = {true, factor_ * rays_[i].ray.origin.x};
    while (thread_cpu_seconds() - begun < seconds_) {
    }
  }
  std::vector<Answer> answers() const override { return answers_; }
  Vec3 normal(std::size_t) const override { return {}; }
  void unload() override { rays_.clear(); }

  std::size_t most_loaded() const { return most_loaded_; }
  bool is_unloaded() const { return rays_.empty(); }

 private:
  double factor_, seconds_;
  std::vector<RayQuery> rays_;
  std::vector<Answer> answers_;
  std::size_t most_loaded_ = 0;
};

// 600 blocks of 2 ms would take longer than a tenth of a second twelve times over.
TEST(SampledRace, HasTheSlowTraceASampleAndCountsAsIfTheyTracedAll) {
  std::vector<std::unique_ptr<Tracer>> tracers;
  tracers.push_back(std::make_unique<NumberTracer>(1, 0.0001));
  tracers.push_back(std::make_unique<NumberTracer>(1, 0.002));
  tracers.push_back(std::make_unique<NumberTracer>(1.5, 0.002));
  const RaySet set = numbered_rays();
  const SampledRace race = race_on_samples(tracers, set);
  const auto loaded = [&](std::size_t i) { return dynamic_cast<const NumberTracer&>(*tracers[i]).most_loaded(); };

  EXPECT_EQ(loaded(0), set.rays.size());
  EXPECT_LE(loaded(1), set.rays.size() / 12);
  ASSERT_EQ(race.timings.size(), 3U);
  ASSERT_EQ(race.timings[1].seconds.size(), 5U);
  // All 600 blocks would have taken 1.2 s, but for what reading the clock takes.
  EXPECT_GT(race.timings[1].median(), 0.8 * 0.002 * blocks);
  EXPECT_LT(race.timings[1].median(), 1.5 * 0.002 * blocks);

  EXPECT_EQ(race.disagreements, (std::vector<std::size_t>{0, 0, loaded(2)}));
  for (const auto& tracer : tracers) EXPECT_TRUE(dynamic_cast<const NumberTracer&>(*tracer).is_unloaded());
}

// Which by chance has more, or fewer, of the rays that take long.
TEST(SampledRace, TellsBySampledRaysAsMuchAsTheirShareOfTheWork) {
  class UnevenTracer final : public Tracer {
   public:
    explicit UnevenTracer(double seconds) : Tracer("uneven"), seconds_(seconds) {}
    void load(const RaySet& set, int) override { set_ = &set; }
    void trace(std::size_t begin, std::size_t, int) override {
      // 21 is a Fibonacci number: but for the first one, all of these miss the samples.
      const auto place = static_cast<std::size_t>(set_->rays[begin].ray.origin.x) / block;
      const double begun = thread_cpu_seconds(), least = place % 21 == 0 ? 20 * seconds_ : seconds_;
      while (thread_cpu_seconds() - begun < least) {
      }
    }
    std::vector<Answer> answers() const override { return std::vector<Answer>(set_->rays.size()); }
    Vec3 normal(std::size_t) const override { return {}; }
    void unload() override {}

   private:
    const double seconds_;
    const RaySet* set_ = nullptr;
  };
  std::vector<std::unique_ptr<Tracer>> tracers;
  tracers.push_back(std::make_unique<UnevenTracer>(0.00002));
  tracers.push_back(std::make_unique<UnevenTracer>(0.0004));
  const SampledRace race = race_on_samples(tracers, numbered_rays());
  EXPECT_NEAR(ratio(race.timings[1], race.timings[0]), 20, 3);
}

// Where a picture's rows are 40 blocks long, one in four in a row would be columns.
TEST(SampledRace, LooksAtAllColumnsOfThePicture) {
  class ColumnTracer final : public Tracer {
   public:
    ColumnTracer() : Tracer("columns") {}
    void load(const RaySet& set, int) override { set_ = &set; }
    void trace(std::size_t begin, std::size_t, int) override {
      ++seen[static_cast<std::size_t>(set_->rays[begin].ray.origin.x) / block % 40];
      const double begun = thread_cpu_seconds();
      while (thread_cpu_seconds() - begun < 0.0003) {
      }
    }
    std::vector<Answer> answers() const override { return std::vector<Answer>(set_->rays.size()); }
    Vec3 normal(std::size_t) const override { return {}; }
    void unload() override {}

    std::array<int, 40> seen{};

   private:
    const RaySet* set_ = nullptr;
  };
  std::vector<std::unique_ptr<Tracer>> tracers;
  tracers.push_back(std::make_unique<NumberTracer>(1, 0));
  tracers.push_back(std::make_unique<ColumnTracer>());
  race_on_samples(tracers, numbered_rays());
  for (const int times : dynamic_cast<const ColumnTracer&>(*tracers[1]).seen) EXPECT_GT(times, 0);
}

}  // namespace
}  // namespace tenon::bench
