#pragma once

#include <string>
#include <vector>

#include "rays/ray_sets.h"

namespace tenon::bench {

/// What a contender says of a ray. Shadow rays have `hit` alone.
struct Answer {
  bool hit = false;
  double t = 0;
};

/// One way to trace stored rays. Everything but trace() is outside of the timing.
class Tracer {
 public:
  explicit Tracer(std::string name) : name_(std::move(name)) {}
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;
  virtual ~Tracer() = default;

  const std::string& name() const { return name_; }

  /// Gets the rays into the contender's own form, with nothing traced yet.
  virtual void load(const RaySet& set, int threads) = 0;
  /// Traces the rays from `begin` up to `end`; `begin` is a multiple of `block`.
  virtual void trace(std::size_t begin, std::size_t end, int worker) = 0;
  virtual std::vector<Answer> answers() const = 0;
  /// Of the surface that a ray hits: length 1, either side.
  virtual Vec3 normal(std::size_t ray) const = 0;
  /// Lets go of what load() took.
  virtual void unload() = 0;

  static constexpr std::size_t block = 256;

 private:
  std::string name_;
};

}  // namespace tenon::bench
