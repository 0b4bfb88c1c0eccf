#include "rays/answers.h"

#include <cmath>

#include "tenon/base/atomic_file.h"
#include "tenon/image/picture_file.h"
#include "tenon/math/color.h"

namespace tenon::bench {

std::size_t count_disagreements(const std::vector<Answer>& a, const std::vector<Answer>& b, RayKind kind) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool both = a[i].hit && b[i].hit && kind != RayKind::shadow;
    count += a[i].hit != b[i].hit || (both && std::fabs(a[i].t - b[i].t) > 0.01 * a[i].t);
  }
  return count;
}

Status save_answers(const RaySet& primary, const Tracer& tracer, const std::string& path) {
  const std::vector<Answer> answers = tracer.answers();
  std::vector<float> rgb(3 * static_cast<std::size_t>(picture_width) * picture_height);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const PixelPlace place = pixel_place(i);
    Rgb color{0.3, 0.4, 0.6};
    if (answers[i].hit) {
      Vec3 n = tracer.normal(i);
      const double facing = dot(n, primary.rays[i].ray.direction);
      if (facing > 0) n = -n;
      const double light = 0.2 + 0.8 * std::fabs(facing);
      color = light * Rgb{0.5 + 0.4 * n.x, 0.5 + 0.4 * n.y, 0.5 + 0.4 * n.z};
    }
    float* pixel = &rgb[3 * (static_cast<std::size_t>(place.y) * picture_width + static_cast<std::size_t>(place.x))];
    pixel[0] = static_cast<float>(color.r);
    pixel[1] = static_cast<float>(color.g);
    pixel[2] = static_cast<float>(color.b);
  }
  const Result<std::string> png = encode_png({picture_width, picture_height, rgb, {}}, 8, {});
  if (!png) return png.error();
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  if (Status status = file->write(*png); !status) return status;
  return file->commit();
}

}  // namespace tenon::bench
