#include "tenon/base/huge_pages.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace tenon {

void* allocate_huge(std::size_t bytes, std::size_t alignment) {
  constexpr std::size_t page = std::size_t{1} << 21;
  const bool is_large = bytes >= page;
  const std::size_t unit = is_large ? page : std::max(alignment, sizeof(void*));
  void* memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // Only advice: where it is refused, pages are small.
  if (is_large) (void)madvise(memory, bytes, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_huge(void* memory) {
  std::free(memory);
}

}  // namespace tenon
