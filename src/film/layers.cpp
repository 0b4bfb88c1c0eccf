#include "tenon/film/layers.h"

namespace tenon {

const std::array<LayerName, layer_count>& layer_names() {
  static constexpr std::array<LayerName, layer_count> names{{
      {Layer::depth, "Z", "distance to what is seen, of the pixel's first sample; infinite where nothing is"},
      {Layer::normal, "N", "N.X N.Y N.Z, the solid's outward normal in the world, the mean of the samples"},
      {Layer::point, "P", "P.X P.Y P.Z, the place in the world, of the first sample; 0 where nothing is"},
      {Layer::albedo, "albedo", "albedo.R albedo.G albedo.B, the share of light the surface returns, the mean"},
      {Layer::ids, "ids",
       "id.primitive (what `tenon trace` calls id, plus 1), id.material, id.solid, of the first sample; whole numbers "
       "from 1, 0 where nothing is"},
      {Layer::crossings, "crossings", "boundaries of the solid along the pixel's whole ray, the mean"},
      {Layer::path_length, "path_length", "length of the pixel's whole ray inside the solid, the mean: an X-ray"},
      {Layer::samples, "samples", "how many samples the pixel has"},
      {Layer::variance, "variance",
       "variance.R variance.G variance.B, of the mean, as if samples were independent; error.R error.G error.B, half "
       "of what differs between two halves of the samples"},
      {Layer::sums, "sums", "exact sums, for `tenon merge`; always there with --samples or --crop"},
  }};
  return names;
}

Result<Layers> parse_layers(std::string_view text) {
  Layers layers;
  if (text == "none") return layers;
  for (;;) {
    const std::size_t comma = text.find(',');
    const std::string_view word = text.substr(0, comma);
    bool known = word == "all";
    for (const LayerName& name : layer_names()) {
      if (name.name == word || (word == "all" && name.layer != Layer::sums)) layers.add(name.layer), known = true;
    }
    if (!known) {
      std::string there_are = "all, none";
      for (const LayerName& name : layer_names()) there_are += ", " + std::string(name.name);
      return Error{ErrorKind::usage, "there is no layer '" + std::string(word) + "'; there are: " + there_are, {}};
    }
    if (comma == std::string_view::npos) return layers;
    text.remove_prefix(comma + 1);
  }
}

std::string layers_text(const Layers& layers) {
  std::string text;
  for (const LayerName& name : layer_names()) {
    if (layers.has(name.layer)) text += (text.empty() ? "" : ",") + std::string(name.name);
  }
  return text.empty() ? "none" : text;
}

}  // namespace tenon
