#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <tuple>

#include "primitive/local_box.h"
#include "primitive/local_ray.h"
#include "tenon/primitive/crossing.h"
#include "tenon/primitive/primitive_store.h"

namespace tenon {

/// A parameter of a primitive: its name in the scene language, its unit, where it lives, and what it means. Its default
/// is the member's initialiser.
template <class P, class T>
struct Field {
  std::string_view name;
  Unit unit;
  T P::*member;
  std::string_view doc;
};
template <class P, class T>
Field(std::string_view, Unit, T P::*, std::string_view) -> Field<P, T>;

/// What a solid has to know to be traced: a plain value in its local frame.
///
///   name, scad_name, doc   what it is called (PrimitiveKind)
///   bounded                whether support() is finite in every direction
///   relative_cost          cost of spans() relative to the sphere's
///   own_cost()             if any: the same of this very solid, where it depends on its size
///   fields()               a tuple of Field
///   check()                why the values make no solid; empty when they do
///   support(n)             max n·p over the solid; gives bounds under any affine map, and slabs of any normal
///   spans(ray, out)        appends all crossings, sorted (Crossing, LocalRay)
///   classify(box)          conservative: may say straddles, is never wrong
///   normal(point, face)    outward, any length but zero
///   spans_within(ray, window, out)   if any: the same of the crossings whose intervals reach into a window of the
///   line,
///                          unless they cannot be told from others beyond it; others may be missing, or be made up, as
///                          long as inside and outside are right within
///   window_share()         with spans_within(): the share of spans() that it costs in the smallest of windows
///   tells_from_start       with spans_within(): a ray of the world needs no more than the window from 0 on
///   crossing_near(ray, t, near, entering)   if any: the crossing of spans() within `near` of t, if it is certainly the
///                          only one within twice that; nothing where that takes the whole of spans() to tell
///   next_crossing(ray, search)   if any: the first crossing of spans() behind a place (CrossingSearch)
///   tells_packets(), next_crossings(rays, found)   with next_crossing(): whether there is something to say of rays
///                          together, and the first ones behind where the rays of a packet begin; nothing is written
///                          of rays that are sooner asked by themselves
///   planes_within(box, planes)   if any: how some planes, with normals of length 1, make up the part of the solid
///                          within the box (PlanarPart)
///   walls_within(box, most, part)   if any: the solid within the box as an outline that is swept, twisted or turned
///                          (SweptPart, TwistedPart, RevolvedPart); false where more walls than `most` go through it,
///                          or that is not certain
template <class P>
concept SolidPrimitive = std::semiregular<P> &&
    requires(const P& p, const LocalRay& ray, Spans& out, const LocalBox& box, const Vec3& v, std::uint32_t face) {
  { P::name } -> std::convertible_to<std::string_view>;
  { P::scad_name } -> std::convertible_to<std::string_view>;
  { P::doc } -> std::convertible_to<std::string_view>;
  { P::bounded } -> std::convertible_to<bool>;
  { P::relative_cost } -> std::convertible_to<double>;
  P::fields();
  { p.check() } -> std::same_as<std::string>;
  { p.support(v) } -> std::same_as<double>;
  { p.spans(ray, out) } -> std::same_as<void>;
  { p.classify(box) } -> std::same_as<Region>;
  { p.normal(v, face) } -> std::same_as<Vec3>;
};

}  // namespace tenon
