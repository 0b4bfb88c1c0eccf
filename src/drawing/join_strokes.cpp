#include "drawing/join_strokes.h"

#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace tenon {

namespace {

using Node = std::uint32_t;

/// Numbers places; what lies within a distance of one that has a number is that.
class Places {
 public:
  explicit Places(double distance) : distance_(distance) {}

  Node number(const Vec2& p) {
    const double x = std::floor(p.x / distance_), y = std::floor(p.y / distance_);
    for (const double dx : {0.0, -1.0, 1.0}) {
      for (const double dy : {0.0, -1.0, 1.0}) {
        const auto cell = cells_.find(key(x + dx, y + dy));
        if (cell == cells_.end()) continue;
        for (const Node node : cell->second) {
          if (length(points_[node] - p) <= distance_) return node;
        }
      }
    }
    const Node node = static_cast<Node>(points_.size());
    points_.push_back(p);
    cells_[key(x, y)].push_back(node);
    return node;
  }

  const Vec2& point(Node node) const { return points_[node]; }
  std::size_t count() const { return points_.size(); }

 private:
  // Cells may share a key; the distance is asked anyway.
  static std::uint64_t key(double x, double y) {
    const auto bits = [](double v) { return static_cast<std::uint64_t>(std::hash<double>{}(v + 0.0)); };
    return bits(x) * 0x9e3779b97f4a7c15u ^ (bits(y) + 0x7f4a7c15u);
  }

  double distance_;
  std::vector<Vec2> points_;
  std::unordered_map<std::uint64_t, std::vector<Node>> cells_;
};

class Joiner {
 public:
  Joiner(const std::vector<Stroke>& strokes, double distance) : strokes_(strokes), places_(distance) {
    for (const Stroke& stroke : strokes) ends_.push_back({places_.number(stroke.from), places_.number(stroke.to)});
    at_.resize(places_.count());
    next_.resize(places_.count());
    left_.resize(places_.count());
    used_.resize(strokes.size());
    for (std::size_t i = 0; i < strokes.size(); ++i) {
      used_[i] = ends_[i][0] == ends_[i][1];
      for (const Node node : ends_[i]) {
        if (used_[i]) continue;
        at_[node].push_back(i);
        ++left_[node];
      }
    }
  }

  std::vector<Path> join() {
    std::vector<Path> paths;
    for (std::size_t i = 0; i < strokes_.size(); ++i) {
      for (const Node end : ends_[i]) {
        if (!used_[i] && left_[end] == 1) paths.push_back(walk(i, end));
      }
    }
    for (std::size_t i = 0; i < strokes_.size(); ++i) {
      if (!used_[i]) paths.push_back(walk(i, ends_[i][0]));
    }
    return paths;
  }

 private:
  Path walk(std::size_t stroke, Node start) {
    Path path;
    Node at = start;
    for (;;) {
      const bool forward = ends_[stroke][0] == at;
      const Vec2& p = places_.point(at);
      path.corners.push_back({p.x, p.y, forward ? strokes_[stroke].bulge : -strokes_[stroke].bulge});
      use(stroke);
      at = ends_[stroke][forward ? 1 : 0];
      path.closed = at == start;
      const auto next = unused_at(at);
      if (path.closed || !next) break;
      stroke = *next;
    }
    if (!path.closed) path.corners.push_back({places_.point(at).x, places_.point(at).y, 0});
    return path;
  }

  void use(std::size_t stroke) {
    used_[stroke] = true;
    for (const Node node : ends_[stroke]) --left_[node];
  }

  // The first of the strokes at a place that no path has.
  std::optional<std::size_t> unused_at(Node node) {
    std::size_t& next = next_[node];
    while (next < at_[node].size() && used_[at_[node][next]]) ++next;
    return next < at_[node].size() ? std::optional(at_[node][next]) : std::nullopt;
  }

  const std::vector<Stroke>& strokes_;
  Places places_;
  std::vector<std::array<Node, 2>> ends_;     // of each stroke
  std::vector<std::vector<std::size_t>> at_;  // the strokes at each place
  std::vector<std::size_t> next_;             // before it in at_, all are used
  std::vector<std::size_t> left_;             // how many of them are not
  std::vector<bool> used_;
};

}  // namespace

std::vector<Path> join_strokes(const std::vector<Stroke>& strokes, double distance) {
  return Joiner(strokes, distance).join();
}

}  // namespace tenon
