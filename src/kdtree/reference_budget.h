#pragma once

#include <cstddef>
#include <utility>

namespace tenon {

/// How many references to primitives the cells below a node may hold.
///
/// A primitive that a plane cuts is referred to from both sides, and where many overlap in one place each level of a
/// tree doubles them all: a limit on the depth alone bounds neither memory nor time. So the root is given a number of
/// references in proportion to its primitives, a node hands its share down in proportion to what each side holds, and
/// one whose share does not cover a split becomes a leaf. The shares never add up to more than the root's, whatever
/// the order in which nodes are built.
class ReferenceBudget {
 public:
  /// The root's. Separable scenes need 3 to 8 references a primitive at the usual depths; the constant lets small
  /// scenes reach the depth their paper gives them.
  static ReferenceBudget of_root(std::size_t primitives) { return ReferenceBudget(16 * primitives + 4096); }

  bool covers(std::size_t below, std::size_t above) const { return below + above <= references_; }

  /// The shares of the two sides; each covers what its side holds already.
  std::pair<ReferenceBudget, ReferenceBudget> divide(std::size_t below, std::size_t above) const {
    const std::size_t spare = references_ - below - above;
    const auto part = static_cast<std::size_t>(static_cast<double>(spare) * static_cast<double>(below) /
                                               static_cast<double>(below + above));
    const std::size_t spare_below = part < spare ? part : spare;
    return {ReferenceBudget(below + spare_below), ReferenceBudget(above + spare - spare_below)};
  }

 private:
  explicit ReferenceBudget(std::size_t references) : references_(references) {}

  std::size_t references_;
};

}  // namespace tenon
