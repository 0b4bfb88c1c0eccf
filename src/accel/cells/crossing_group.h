#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "accel/cells/cell.h"

namespace tenon::cells {

/// Which ends of a cell's leaves coincide, and the state behind them, as one word.
struct CoincidentEnds {
  static constexpr int left_shift = Cell::most_tabled, after_shift = 2 * Cell::most_tabled;
  static constexpr int bits = 3 * Cell::most_tabled;
  static constexpr std::uint32_t all_places = (1U << Cell::most_tabled) - 1;
  std::uint32_t word = 0;  ///< 0: none do

  std::uint32_t entered() const { return word & all_places; }
  std::uint32_t left() const { return word >> left_shift & all_places; }
  std::uint32_t after() const { return word >> after_shift & all_places; }
};

/// Crossings of a cell's leaves that certainly form one run: their bounds are at least the scene's tolerance, and they
/// are no further apart. The rules are those of the classifier, on a cell's table: `value_of(state)` is what it says.
struct CrossingGroup {
  struct End {
    double t = 0;
    std::uint32_t place = 0;
    bool entering = false;
  };
  End ends[Cell::most_tabled];
  std::uint32_t size = 0;

  /// Keeps the order of the classifier.
  void add(const End& end) {
    std::uint32_t place = size++;
    for (; place > 0; --place) {
      const End& other = ends[place - 1];
      if (other.t < end.t || (other.t == end.t && other.place < end.place)) break;
      ends[place] = other;
    }
    ends[place] = end;
  }
  std::span<const End> all() const { return {ends, size}; }

  /// Collects the crossings at t. A chord is longer than four resolutions, so one of its ends at most is near.
  /// @param near      crossings further apart than this are told apart for certain
  /// @param together  crossings no further apart than this certainly are one boundary
  /// @return false when some may or may not belong to it
  bool collect(std::uint32_t count, const double* enter, const double* leave, double t, double near, double together) {
    size = 0;
    const auto take = [&](double end, std::uint32_t place, bool entering) {
      const double apart = std::fabs(end - t);
      if (!(apart <= near)) return true;
      if (!(apart <= together) || size == Cell::most_tabled) return false;
      add({end, place, entering});
      return true;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!take(enter[i], i, true) || !take(leave[i], i, false)) return false;
    }
    return true;
  }

  /// The state behind them all, from one in which some of them have been crossed.
  std::uint32_t after(std::uint32_t state) const {
    for (std::uint32_t k = 0; k < size; ++k) {
      const std::uint32_t bit = 1U << ends[k].place;
      state = ends[k].entering ? state | bit : state & ~bit;
    }
    return state;
  }

  /// Where the faces cancel: what each of their leaves is crossed by next.
  void skip(const double* leave, double* next) const {
    for (std::uint32_t k = 0; k < size; ++k) {
      const std::uint32_t i = ends[k].place;
      next[i] = ends[k].entering ? leave[i] : std::numeric_limits<double>::infinity();
    }
  }

  template <class ValueOf>
  const End& first_change(const ValueOf& value_of, std::uint32_t after) const {
    std::uint32_t state = before(after);
    const auto value = value_of(state);
    for (std::uint32_t k = 0; k < size; ++k) {
      state ^= 1U << ends[k].place;
      if (value_of(state) != value) return ends[k];
    }
    return ends[0];
  }

  /// The places of the leaves whose bits alone change the value before all of them or behind all of them, a bit each.
  template <class ValueOf>
  std::uint32_t faces(const ValueOf& value_of, std::uint32_t after) const {
    std::uint32_t places = 0;
    for (const std::uint32_t state : {before(after), after}) {
      const auto value = value_of(state);
      for (std::uint32_t k = 0; k < size; ++k) {
        const std::uint32_t bit = 1U << ends[k].place;
        if (value_of(state ^ bit) != value) places |= bit;
      }
    }
    return places;
  }

  /// Whether the leaf at a place is entered; it is one of them.
  bool enters(std::uint32_t place) const {
    std::uint32_t k = 0;
    while (ends[k].place != place) ++k;
    return ends[k].entering;
  }

  /// What shows: the first leaf of `faces`; without any the first change.
  template <class ValueOf>
  const End& shown(const ValueOf& value_of, std::uint32_t after, std::uint32_t faces) const {
    for (std::uint32_t k = 0; k < size; ++k) {
      if (faces != 0 && ends[k].place == static_cast<std::uint32_t>(std::countr_zero(faces))) return ends[k];
    }
    return first_change(value_of, after);
  }

  /// The state before them all.
  std::uint32_t before(std::uint32_t after) const {
    for (std::uint32_t k = 0; k < size; ++k) after ^= 1U << ends[k].place;
    return after;
  }
};

}  // namespace tenon::cells
