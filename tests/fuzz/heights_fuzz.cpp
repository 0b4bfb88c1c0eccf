#include <cstdint>

#include "fuzz/try_heights.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tenon::fuzz::try_heights({"fuzz" TENON_FUZZ_ENDING, std::string(reinterpret_cast<const char*>(data), size)});
  return 0;
}
