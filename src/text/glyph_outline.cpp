#include "text/glyph_outline.h"

#include FT_OUTLINE_H

#include "plane/arc_fit.h"
#include "plane/shape.h"

namespace tenon {

namespace {

Vec2 point_of(const FT_Vector* v) {
  return {static_cast<double>(v->x), static_cast<double>(v->y)};
}

/// Takes the parts of a glyph from FreeType.
class GlyphBuilder {
 public:
  GlyphBuilder(double tolerance, int segments) : tolerance_(tolerance), segments_(segments) {}

  Outline take(FT_Outline& outline) {
    FT_Outline_Funcs functions{};
    functions.move_to = [](const FT_Vector* to, void* self) { return builder(self).move_to(point_of(to)); };
    functions.line_to = [](const FT_Vector* to, void* self) { return builder(self).line_to(point_of(to)); };
    functions.conic_to = [](const FT_Vector* control, const FT_Vector* to, void* self) {
      return builder(self).conic_to(point_of(control), point_of(to));
    };
    functions.cubic_to = [](const FT_Vector* control1, const FT_Vector* control2, const FT_Vector* to, void* self) {
      return builder(self).cubic_to(point_of(control1), point_of(control2), point_of(to));
    };
    // A glyph that FreeType finds broken is drawn up to there.
    FT_Outline_Decompose(&outline, &functions, this);
    return resolve_winding(outline_);
  }

 private:
  static GlyphBuilder& builder(void* self) { return *static_cast<GlyphBuilder*>(self); }

  int move_to(const Vec2& to) {
    outline_.loops.emplace_back();
    at_ = to;
    return 0;
  }
  // A contour ends where it began, so that the corner at the end of each part is left to the next one.
  int line_to(const Vec2& to) {
    outline_.loops.back().push_back({at_.x, at_.y, 0});
    at_ = to;
    return 0;
  }
  int conic_to(const Vec2& c, const Vec2& to) {
    const Vec2 from = at_;
    return curve_to(to, [=](double t) { return (1 - t) * (1 - t) * from + 2 * t * (1 - t) * c + t * t * to; });
  }
  int cubic_to(const Vec2& c, const Vec2& d, const Vec2& to) {
    const Vec2 from = at_;
    return curve_to(to, [=](double t) {
      const double s = 1 - t;
      return s * s * s * from + 3 * s * s * t * c + 3 * s * t * t * d + t * t * t * to;
    });
  }

  int curve_to(const Vec2& to, const ParametricCurve& curve) {
    if (segments_ == 0) {
      fit_arcs(curve, 0, 1, tolerance_, outline_.loops.back());
    } else {
      for (int i = 0; i < segments_; ++i) {
        const Vec2 p = curve(static_cast<double>(i) / segments_);
        outline_.loops.back().push_back({p.x, p.y, 0});
      }
    }
    at_ = to;
    return 0;
  }

  double tolerance_;
  int segments_;
  Outline outline_;
  Vec2 at_;
};

}  // namespace

Outline glyph_outline(FT_Outline& outline, double tolerance, int segments) {
  return GlyphBuilder(tolerance, segments).take(outline);
}

}  // namespace tenon
