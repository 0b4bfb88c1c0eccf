#pragma once

#include <compare>
#include <cstdint>
#include <functional>

namespace tenon {

/// An index that cannot be mistaken for another kind of index: `Id<struct Leaf_>` and `Id<struct Node_>` do not mix.
template <class Tag>
class Id {
 public:
  using value_type = std::uint32_t;
  static constexpr value_type none_value = ~value_type{0};

  constexpr Id() = default;
  constexpr explicit Id(std::size_t value) : value_(static_cast<value_type>(value)) {}

  /// False for a default-constructed id.
  constexpr explicit operator bool() const { return value_ != none_value; }
  constexpr value_type get() const { return value_; }

  friend constexpr auto operator<=>(Id, Id) = default;

 private:
  value_type value_ = none_value;
};

}  // namespace tenon

template <class Tag>
struct std::hash<tenon::Id<Tag>> {
  std::size_t operator()(tenon::Id<Tag> id) const noexcept { return id.get(); }
};
