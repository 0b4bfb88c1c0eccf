#pragma once

#include <cstddef>
#include <vector>

namespace tenon {

/// Memory on pages of 2 MiB where the system has them, so that few reads of a large array have to look up where a page
/// lies. What is smaller than a page is taken as always.
/// @return never null: std::bad_alloc is thrown when there is none left, as by operator new
void* allocate_huge(std::size_t bytes, std::size_t alignment);
void free_huge(void* memory);

/// For the vectors of what rays read all over.
template <class T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_huge(count * sizeof(T), alignof(T))); }
  void deallocate(T* memory, std::size_t) { free_huge(memory); }
  friend bool operator==(HugePageAllocator, HugePageAllocator) { return true; }
};

template <class T>
using HugePageVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace tenon
