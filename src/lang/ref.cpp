#include "lang/ref.h"

#include <vector>

namespace tenon::lang {

void RefCounted::bury(RefCounted* object) {
  thread_local std::vector<RefCounted*> waiting;
  thread_local bool digging = false;
  if (digging) {
    waiting.push_back(object);
    return;
  }
  digging = true;
  delete object;
  while (!waiting.empty()) {
    RefCounted* next = waiting.back();
    waiting.pop_back();
    delete next;
  }
  digging = false;
}

}  // namespace tenon::lang
