#pragma once

#include <cstddef>
#include <functional>

namespace tenon::lang {

/// Runs `work` on a thread whose stack is deep enough for 100,000 nested modules, and returns when it is done. Memory
/// is taken only as far as the stack grows. What `work` throws must not leave it.
void run_on_deep_stack(const std::function<void()>& work);

/// True while calls may nest further; false near the end of a deep stack.
bool stack_remains();

}  // namespace tenon::lang
