#include "mesh/convex_hull.h"

#include <libqhull_r/qhull_ra.h>

#include <cstdio>
#include <limits>
#include <memory>

namespace tenon {

namespace {

/// A run of Qhull; it writes nothing.
class QhullRun {
 public:
  explicit QhullRun(std::span<const Vec3> points) {
    for (const Vec3& p : points) coordinates_.insert(coordinates_.end(), {p.x, p.y, p.z});
    qh_zero(&qh_, sink_.get());
    // Flat input is an error to Qhull; anything else would be, too, without a hull to go on with.
    char command[] = "qhull Pp";
    made_ = sink_ && qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), coordinates_.data(), False, command,
                                  sink_.get(), sink_.get()) == 0;
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;
  ~QhullRun() {
    qh_freeqhull(&qh_, !qh_ALL);
    int long_left = 0, bytes_left = 0;
    qh_memfreeshort(&qh_, &long_left, &bytes_left);
  }

  /// The indices of the corners of each face, in order around it.
  std::vector<std::vector<std::size_t>> faces() {
    std::vector<std::vector<std::size_t>> faces;
    if (!made_) return faces;
    for (facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next) {
      setT* corners = qh_facet3vertex(&qh_, facet);
      auto& face = faces.emplace_back();
      for (int i = 0; i < qh_setsize(&qh_, corners); ++i) {
        const auto* corner = static_cast<const vertexT*>(SETelem_(corners, i));
        face.push_back(static_cast<std::size_t>(qh_pointid(&qh_, corner->point)));
      }
      qh_settempfree(&qh_, &corners);
    }
    return faces;
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> sink_{std::fopen("/dev/null", "w")};
  std::vector<coordT> coordinates_;
  qhT qh_{};
  bool made_ = false;
};

}  // namespace

ConvexHull convex_hull(std::span<const Vec3> points) {
  ConvexHull hull;
  if (points.size() < 4) return hull;
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> number(points.size(), none);
  hull.faces = QhullRun(points).faces();
  for (auto& face : hull.faces) {
    for (std::size_t& corner : face) {
      if (number[corner] == none) {
        number[corner] = hull.points.size();
        hull.points.push_back(points[corner]);
      }
      corner = number[corner];
    }
  }
  return hull;
}

}  // namespace tenon
