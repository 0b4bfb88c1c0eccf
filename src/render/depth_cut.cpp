#include "tenon/render/depth_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/tile_cut.h"

namespace tenon {

namespace {

/// Means over pixels, however many samples each has.
struct PixelMeans {
  double pixels = 0, light = 0, earlier = 0, late = 0;

  void add(const TileCut& of) {
    const auto tile_pixels = static_cast<double>(of.tile.pixels());
    const double weight = tile_pixels / static_cast<double>(of.samples);
    pixels += tile_pixels;
    light += weight * of.paths.light;
    earlier += weight * of.paths.earlier_light;
    late += weight * of.paths.late_light;
  }
};

// 1 where what is lost is without end.
double share_of(double lost, double kept) {
  return 1 - kept / (kept + lost);
}

}  // namespace

DepthCut depth_cut(std::span<const TileCut> tiles) {
  DepthCut cut;
  PixelMeans means;
  for (const TileCut& of : tiles) {
    cut.paths += of.paths.paths;
    if (of.samples > 0) means.add(of);
  }
  if (!(means.late > 0)) return cut;
  const double mean_light = means.light / means.pixels;
  // The next quarters bring r, r^2, ... of the last one: r / (1 - r) of it together.
  const double further =
      means.late < means.earlier ? means.late / (means.earlier - means.late) : std::numeric_limits<double>::infinity();
  double lost = 0;
  for (const TileCut& of : tiles) {
    if (of.samples == 0) continue;
    const auto n = static_cast<double>(of.samples);
    // No more than if what was cut had met as much light as a whole path does, the light that is lost included.
    const double carried = std::min(1.0, of.paths.throughput / n), most = n * carried * mean_light / (1 - carried);
    const auto lost_by = [&](double late) { return late > 0 ? std::min(most, late * further) : 0; };
    lost += static_cast<double>(of.tile.pixels()) / n * lost_by(of.paths.late_light);
    // Late light comes in portions of about the mean, whose number spreads by its root.
    const double late = of.paths.late_light, certain = late - 2 * std::sqrt(std::max(0.0, late * mean_light));
    const double share = share_of(lost_by(certain), of.paths.light);
    if (!(share > cut.largest_share)) continue;
    cut.largest_share = share;
    cut.tile = of.tile;
  }
  cut.share = share_of(lost, means.light);
  return cut;
}

}  // namespace tenon
