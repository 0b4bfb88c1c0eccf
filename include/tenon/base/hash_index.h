#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tenon {

/// Finds elements of a vector by their content: numbers of elements, in an open hash table.
class HashIndex {
 public:
  /// @param is_same  bool(number): whether that element is the one sought
  template <class IsSame>
  std::optional<std::uint32_t> find(std::uint64_t hash, const IsSame& is_same) const {
    if (slots_.empty()) return std::nullopt;
    const std::uint64_t mask = slots_.size() - 1;
    for (std::uint64_t at = hash & mask; slots_[at].index != none; at = (at + 1) & mask) {
      if (slots_[at].hash == hash && is_same(slots_[at].index)) return slots_[at].index;
    }
    return std::nullopt;
  }

  /// Adds an element that find() does not find.
  void note(std::uint64_t hash, std::uint32_t element) {
    if (2 * (used_ + 1) > slots_.size()) grow();
    insert({hash, element});
    ++used_;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  struct Slot {
    std::uint64_t hash = 0;
    std::uint32_t index = none;
  };

  void insert(const Slot& slot) {
    const std::uint64_t mask = slots_.size() - 1;
    std::uint64_t at = slot.hash & mask;
    while (slots_[at].index != none) at = (at + 1) & mask;
    slots_[at] = slot;
  }

  void grow() {
    std::vector<Slot> old(slots_.empty() ? 64 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.index != none) insert(slot);
    }
  }

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

/// The hash of numbers as they lie in memory, mixed so that all bits count (the finaliser of MurmurHash3).
class ContentHash {
 public:
  template <class T>
  void add(const T& number) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_pointer_v<T>);
    std::uint64_t word = 0;
    std::memcpy(&word, &number, sizeof number);
    state_ = mix(state_ ^ word) + 0x9e3779b97f4a7c15ULL;
  }
  void add_text(std::string_view text) {
    for (const char c : text) add(c);
  }
  std::uint64_t value() const { return mix(state_); }

 private:
  static constexpr std::uint64_t mix(std::uint64_t x) {
    x ^= x >> 33;
    x *= 0xff51afd7ed558ccdULL;
    x ^= x >> 33;
    x *= 0xc4ceb9fe1a85ec53ULL;
    return x ^ x >> 33;
  }
  std::uint64_t state_ = 0;
};

}  // namespace tenon
