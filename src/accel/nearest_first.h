#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "accel/walk.h"

namespace tenon {

/// The nodes of a hierarchy that a ray still has to open, nearest entry first.
class EntryQueue {
 public:
  struct Entry {
    double t_in;
    std::uint32_t node;
  };

  bool empty() const { return heap_.empty(); }
  void clear() { heap_.clear(); }

  void push(double t_in, std::uint32_t node) {
    heap_.push_back({t_in, node});
    std::push_heap(heap_.begin(), heap_.end(), farther);
  }
  Entry pop() {
    std::pop_heap(heap_.begin(), heap_.end(), farther);
    const Entry e = heap_.back();
    heap_.pop_back();
    return e;
  }

 private:
  static bool farther(const Entry& a, const Entry& b) { return a.t_in != b.t_in ? a.t_in > b.t_in : a.node > b.node; }
  std::vector<Entry> heap_;
};

/// Opens the nodes in the queue in the order in which the ray enters their volumes. `open` reveals a node's leaves and
/// pushes its children; a child lies within its parent, so whatever is still closed begins at or behind the next entry,
/// and the ray may be settled up to there.
template <class Open>
void nearest_first(Walk& walk, EntryQueue& queue, Open open) {
  while (!queue.empty()) {
    const EntryQueue::Entry next = queue.pop();
    if (walk.settle(next.t_in)) return;
    ++walk.counters().cells_visited;
    open(next.node);
  }
}

}  // namespace tenon
