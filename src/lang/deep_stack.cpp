#include "lang/deep_stack.h"

#include <pthread.h>
#include <sys/mman.h>

#include <cstdint>

namespace tenon::lang {

namespace {

// Sanitizers make frames several times as large.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::size_t stack_size = std::size_t{1} << 32;
#else
constexpr std::size_t stack_size = std::size_t{1} << 29;
#endif
// What one step between two checks may take, with room for the library calls it makes.
constexpr std::size_t reserve = std::size_t{1} << 19;

thread_local std::uintptr_t stack_limit = 0;

struct Job {
  const std::function<void()>* work;
  std::uintptr_t limit;
};

void* run(void* argument) {
  const Job& job = *static_cast<const Job*>(argument);
  stack_limit = job.limit;
  (*job.work)();
  return nullptr;
}

bool run_with_stack(std::size_t size, const std::function<void()>& work) {
  void* stack =
      mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
  if (stack == MAP_FAILED) return false;
  Job job{&work, reinterpret_cast<std::uintptr_t>(stack) + reserve};
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_t thread{};
  const bool started =
      pthread_attr_setstack(&attributes, stack, size) == 0 && pthread_create(&thread, &attributes, run, &job) == 0;
  if (started) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  munmap(stack, size);
  return started;
}

}  // namespace

void run_on_deep_stack(const std::function<void()>& work) {
  // A limit on address space may refuse the first size; less depth is better than none.
  for (std::size_t size = stack_size; size >= 4 * reserve; size /= 4) {
    if (run_with_stack(size, work)) return;
  }
  work();
}

bool stack_remains() {
  return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)) > stack_limit;
}

}  // namespace tenon::lang
