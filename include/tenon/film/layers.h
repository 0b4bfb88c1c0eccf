#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "tenon/base/error.h"

namespace tenon {

/// What a picture may hold beside its colour.
enum class Layer : std::uint8_t {
  depth,        ///< Z
  normal,       ///< N.X N.Y N.Z
  point,        ///< P.X P.Y P.Z
  albedo,       ///< albedo.R albedo.G albedo.B
  ids,          ///< id.primitive id.material id.solid
  crossings,    ///< crossings
  path_length,  ///< path_length
  samples,      ///< samples
  variance,     ///< variance.R variance.G variance.B error.R error.G error.B
  sums,         ///< sums.*: what `merge` and `--resume` need, exactly
};
inline constexpr std::size_t layer_count = 10;

/// A layer as the command line and its help know it.
struct LayerName {
  Layer layer;
  std::string_view name;
  std::string_view doc;
};

/// Every layer, with what it holds.
const std::array<LayerName, layer_count>& layer_names();

/// A set of layers.
class Layers {
 public:
  Layers() = default;
  explicit Layers(std::initializer_list<Layer> layers) {
    for (const Layer layer : layers) add(layer);
  }

  bool has(Layer layer) const { return (bits_ >> static_cast<unsigned>(layer) & 1U) != 0; }
  Layers& add(Layer layer) { return bits_ |= 1U << static_cast<unsigned>(layer), *this; }
  Layers& remove(Layer layer) { return bits_ &= ~(1U << static_cast<unsigned>(layer)), *this; }
  Layers operator|(const Layers& other) const { return Layers(bits_ | other.bits_); }
  bool contains(const Layers& other) const { return (other.bits_ & ~bits_) == 0; }
  bool empty() const { return bits_ == 0; }

  friend bool operator==(const Layers&, const Layers&) = default;

 private:
  explicit Layers(unsigned bits) : bits_(bits) {}

  unsigned bits_ = 0;
};

/// Names with commas between them; "all" (but the sums), "none".
/// @return the layers, or a usage error that lists what there is
Result<Layers> parse_layers(std::string_view text);

/// The names, in the order of layer_names(), with commas between them; "none".
std::string layers_text(const Layers& layers);

}  // namespace tenon
