#include "drawing/svg_path.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include "plane/arc_corners.h"
#include "plane/arc_fit.h"

namespace tenon {

namespace {

constexpr double curve_tolerance = 0x1p-16;
constexpr std::string_view commands = "MmZzLlHhVvCcSsQqTtAa";

/// Reads path data command by command (SVG 1.1, 8.3).
class PathReader {
 public:
  explicit PathReader(std::string_view data) : data_(data) {}

  std::optional<Outline> read() {
    while (skip_separators(), at_ < data_.size()) {
      if (commands.find(data_[at_]) != std::string_view::npos) {
        command_ = data_[at_++];
      } else if (command_ == 0 || command_ == 'Z' || command_ == 'z') {
        return std::nullopt;
      }
      if (!run()) return std::nullopt;
      // Further pairs behind a move are lines.
      if (command_ == 'M') command_ = 'L';
      if (command_ == 'm') command_ = 'l';
    }
    close();
    return std::move(outline_);
  }

 private:
  void skip_separators() {
    while (at_ < data_.size() &&
           (data_[at_] == ' ' || data_[at_] == ',' || (data_[at_] >= '\t' && data_[at_] <= '\r'))) {
      ++at_;
    }
  }

  bool number(double& value) {
    skip_separators();
    if (at_ < data_.size() && data_[at_] == '+') ++at_;
    const auto [end, problem] = std::from_chars(data_.data() + at_, data_.data() + data_.size(), value);
    if (problem != std::errc() || !std::isfinite(value)) return false;
    at_ = static_cast<std::size_t>(end - data_.data());
    return true;
  }
  // One digit, which may stand without a space before the next number.
  bool flag(bool& value) {
    skip_separators();
    if (at_ >= data_.size() || (data_[at_] != '0' && data_[at_] != '1')) return false;
    value = data_[at_++] == '1';
    return true;
  }
  bool point(Vec2& p) {
    if (!number(p.x) || !number(p.y)) return false;
    if (is_relative()) p = p + pen_;
    return true;
  }
  bool is_relative() const { return command_ >= 'a'; }

  bool run() {
    const char before = last_;
    last_ = static_cast<char>(command_ & ~0x20);
    Vec2 to = pen_, c, d;
    switch (last_) {
      case 'M':
        if (!point(to)) return false;
        close();
        pen_ = start_ = to;
        return true;
      case 'Z':
        close();
        pen_ = start_;
        return true;
      case 'L':
        return point(to) && line_to(to);
      case 'H': {
        if (!number(to.x)) return false;
        if (is_relative()) to.x += pen_.x;
        return line_to(to);
      }
      case 'V': {
        if (!number(to.y)) return false;
        if (is_relative()) to.y += pen_.y;
        return line_to(to);
      }
      case 'C':
        return point(c) && point(d) && point(to) && cubic_to(c, d, to);
      case 'S':
        c = before == 'C' || before == 'S' ? 2 * pen_ - control_ : pen_;
        return point(d) && point(to) && cubic_to(c, d, to);
      case 'Q':
        return point(c) && point(to) && conic_to(c, to);
      case 'T':
        c = before == 'Q' || before == 'T' ? 2 * pen_ - control_ : pen_;
        return point(to) && conic_to(c, to);
      default: {
        double rx = 0, ry = 0, turn = 0;
        bool large = false, sweep = false;
        return number(rx) && number(ry) && number(turn) && flag(large) && flag(sweep) && point(to) &&
               arc_to(std::fabs(rx), std::fabs(ry), turn * (std::numbers::pi / 180), large, sweep, to);
      }
    }
  }

  void close() {
    if (loop_.size() > 1 || (loop_.size() == 1 && loop_.front().bulge != 0)) {
      const OutlineCorner& first = loop_.front();
      // The way back is a segment, unless the last command has gone it.
      if (!(first.x == pen_.x && first.y == pen_.y)) loop_.push_back({pen_.x, pen_.y, 0});
      outline_.loops.push_back(std::move(loop_));
    }
    loop_.clear();
  }

  bool line_to(const Vec2& to) {
    loop_.push_back({pen_.x, pen_.y, 0});
    pen_ = to;
    return true;
  }
  bool curve_to(const Vec2& to, double size, const ParametricCurve& curve, double begin, double end) {
    fit_arcs(curve, begin, end, curve_tolerance * size, loop_);
    pen_ = to;
    return true;
  }
  bool cubic_to(const Vec2& c, const Vec2& d, const Vec2& to) {
    const Vec2 from = pen_;
    control_ = d;
    const auto curve = [=](double t) {
      const double s = 1 - t;
      return s * s * s * from + 3 * s * s * t * c + 3 * s * t * t * d + t * t * t * to;
    };
    return curve_to(to, length(c - from) + length(d - c) + length(to - d), curve, 0, 1);
  }
  bool conic_to(const Vec2& c, const Vec2& to) {
    const Vec2 from = pen_;
    control_ = c;
    const auto curve = [=](double t) { return (1 - t) * (1 - t) * from + 2 * t * (1 - t) * c + t * t * to; };
    return curve_to(to, length(c - from) + length(to - c), curve, 0, 1);
  }

  // From ends to centre: SVG 1.1, F.6.
  bool arc_to(double rx, double ry, double turn, bool large, bool sweep, const Vec2& to) {
    if (rx == 0 || ry == 0 || to == pen_) return line_to(to);
    const double cosine = std::cos(turn), sine = std::sin(turn);
    // In units of the radii, along the axes, around the middle of the ends.
    const Vec2 half = 0.5 * (pen_ - to);
    const Vec2 p{(cosine * half.x + sine * half.y) / rx, (cosine * half.y - sine * half.x) / ry};
    const double grow = std::max(1.0, length(p));
    rx *= grow, ry *= grow;
    const Vec2 q = 1 / grow * p;
    const double rest = std::sqrt(std::max(0.0, (1 - length(q)) * (1 + length(q)))) / length(q);
    const double side = large == sweep ? -1 : 1;
    const Vec2 center{side * rest * q.y, -side * rest * q.x};
    const double begin = std::atan2(q.y - center.y, q.x - center.x);
    double angle = std::atan2(-q.y - center.y, -q.x - center.x) - begin;
    if (sweep && angle <= 0) angle += 2 * std::numbers::pi;
    if (!sweep && angle >= 0) angle -= 2 * std::numbers::pi;
    const Vec2 middle = 0.5 * (pen_ + to);
    const auto map = [=](const Vec2& v) {
      const Vec2 scaled{rx * v.x, ry * v.y};
      return middle + Vec2{cosine * scaled.x - sine * scaled.y, sine * scaled.x + cosine * scaled.y};
    };
    if (rx == ry) {
      add_arc(map(center), pen_, angle, loop_);
      pen_ = to;
      return true;
    }
    const Vec2 from = pen_;
    const auto ellipse = [=](double t) {
      return t == 0 ? from : t == 1 ? to : map(center + Vec2{std::cos(begin + t * angle), std::sin(begin + t * angle)});
    };
    return curve_to(to, rx + ry, ellipse, 0, 1);
  }

  std::string_view data_;
  std::size_t at_ = 0;
  char command_ = 0, last_ = 0;
  Vec2 pen_, start_, control_;
  std::vector<OutlineCorner> loop_;
  Outline outline_;
};

}  // namespace

std::optional<Outline> parse_svg_path(std::string_view data) {
  return PathReader(data).read();
}

}  // namespace tenon
