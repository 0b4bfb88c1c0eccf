#pragma once

#include <cstddef>

#include "tenon/base/function_ref.h"

namespace tenon {

/// The number of threads to use when nobody says: the cores this process may run on, at least 1.
int available_threads();

/// Calls `body(index, worker)` once for each index from 0 to count - 1, on up to `threads` threads, the caller's among
/// them. Which worker takes which index is left open; `worker` is below `threads` and never used twice at one time.
///
/// An exception thrown by the body never crosses a thread: no further index is begun, and when all workers are done the
/// first exception is thrown again on the caller's thread. Where the system refuses a thread, fewer do the work.
void parallel_for(std::size_t count, int threads, FunctionRef<void(std::size_t index, int worker)> body);

}  // namespace tenon
