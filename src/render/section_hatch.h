#pragma once

#include "tenon/accel/accelerator.h"
#include "tenon/render/camera_rays.h"
#include "tenon/render/hatch.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// A place in a picture, in pixels from its upper left corner.
struct PicturePlace {
  double x = 0, y = 0;
};

/// The ink on the cut faces of a section view. It lies over whatever the face shows, and takes a share of its light.
class SectionHatch {
 public:
  /// @param samples  of each pixel; the lines of one sample are as sharp as their number allows
  SectionHatch(const Scene& scene, const CameraRays& camera, const HatchOptions& options, int samples);

  /// The share of light that the ink lets through where the ray through a place of the picture meets the solid.
  double light(const Hit& hit, const PicturePlace& at) const;

 private:
  // Of a place along the direction across the lines, in spacings, and how far it moves from a pixel to the next.
  struct Across {
    double place, per_pixel;
  };
  Across in_plane(const Hit& hit, double angle, double spacing, const PicturePlace& at) const;
  Across in_picture(double angle, double spacing, const PicturePlace& at) const;

  CameraRays camera_;
  LeafId first_plane_;
  HatchOptions options_;
  double sharpness_;
};

}  // namespace tenon
