#include "rays/ray_sets.h"

#include <cmath>
#include <numbers>

namespace tenon::bench {

namespace {

constexpr int tile = 16;
constexpr std::size_t tile_pixels = tile * tile;

// SplitMix64 (Steele, Lea, Flood 2014) at a place in its sequence: the same number for a ray whatever was drawn before.
double random_number(std::uint64_t index) {
  std::uint64_t z = (index + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

// By Malley's method: a point of the unit disc, lifted to the hemisphere.
Vec3 cosine_direction(const Vec3& normal, double u, double v) {
  const Vec3 a = abs(normal);
  const Vec3 other = a.x <= a.y && a.x <= a.z ? Vec3{1, 0, 0} : a.y <= a.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 s = normalize(cross(normal, other)), t = cross(normal, s);
  const double radius = std::sqrt(u), angle = 2 * std::numbers::pi * v;
  return normalize(radius * std::cos(angle) * s + radius * std::sin(angle) * t + std::sqrt(1 - u) * normal);
}

RayQuery query_of(const Ray& ray, RayKind kind) {
  RayQuery query;
  query.ray = ray;
  query.kind = kind;
  return query;
}

Vec3 towards(const Light& light, const Vec3& point) {
  return light.kind == LightKind::directional ? -light.direction : light.position - point;
}

}  // namespace

PixelPlace pixel_place(std::size_t i) {
  constexpr std::size_t columns = picture_width / tile;
  const std::size_t tile_index = i / tile_pixels, within = i % tile_pixels;
  int x = 0, y = 0;
  for (int bit = 0; bit < 4; ++bit) {
    x |= static_cast<int>(within >> (2 * bit) & 1U) << bit;
    y |= static_cast<int>(within >> (2 * bit + 1) & 1U) << bit;
  }
  return {static_cast<int>(tile_index % columns) * tile + x, static_cast<int>(tile_index / columns) * tile + y};
}

double small_lift(const BenchScene& scene) {
  return 1e-6 * length(scene.scene.camera.at - scene.scene.camera.from);
}

std::vector<RaySet> make_ray_sets(const BenchScene& scene, const Accelerator& accelerator, double lift) {
  static_assert(picture_width % tile == 0 && picture_height % tile == 0);
  constexpr std::size_t pixels = static_cast<std::size_t>(picture_width) * picture_height;
  RaySet primary{RayKind::primary, {}}, shadow{RayKind::shadow, {}}, diffuse{RayKind::diffuse, {}};
  for (std::size_t i = 0; i < pixels; ++i) {
    const PixelPlace place = pixel_place(i);
    RayQuery query = query_of(scene.camera.ray(place.x + 0.5, place.y + 0.5), RayKind::primary);
    query.pixel_x = place.x, query.pixel_y = place.y;
    primary.rays.push_back(query);
  }
  const auto context = accelerator.make_context();
  std::vector<Hit> hits(tile_pixels);
  for (std::size_t begin = 0; begin < pixels; begin += tile_pixels) {
    const std::span<const RayQuery> queries(primary.rays.data() + begin, tile_pixels);
    accelerator.first_hits(queries, hits, *context);
    std::vector<std::pair<Vec3, Vec3>> starts;  // place above the surface, and normal
    for (std::size_t i = 0; i < tile_pixels; ++i) {
      if (!hits[i].found()) continue;
      const Vec3 normal = dot(hits[i].normal, queries[i].ray.direction) > 0 ? -hits[i].normal : hits[i].normal;
      const Vec3 start = hits[i].point + lift * normal;
      starts.emplace_back(start, normal);
      const double u = random_number(2 * (begin + i)), v = random_number(2 * (begin + i) + 1);
      diffuse.rays.push_back(query_of({start, cosine_direction(normal, u, v)}, RayKind::diffuse));
    }
    for (const Light& light : scene.scene.lights) {
      for (const auto& [start, normal] : starts) {
        const Vec3 to_light = towards(light, start);
        if (!(dot(to_light, normal) > 0)) continue;
        shadow.rays.push_back(query_of({start, to_light}, RayKind::shadow));
        if (light.kind != LightKind::directional) shadow.rays.back().t_max = 1;
      }
    }
  }
  std::vector<RaySet> sets;
  sets.push_back(std::move(primary));
  sets.push_back(std::move(shadow));
  sets.push_back(std::move(diffuse));
  return sets;
}

}  // namespace tenon::bench
