#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace tenon {

/// A list whose first N elements need no allocation. For small trivially copyable elements.
template <class T, std::size_t N>
class InlineVector {
 public:
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](std::size_t i) const { return i < N ? head_[i] : tail_[i - N]; }

  void push_back(const T& value) {
    if (size_ < N) {
      head_[size_] = value;
    } else {
      tail_.push_back(value);
    }
    ++size_;
  }
  void clear() {
    size_ = 0;
    tail_.clear();
  }

 private:
  std::array<T, N> head_{};
  std::vector<T> tail_;
  std::size_t size_ = 0;
};

}  // namespace tenon
