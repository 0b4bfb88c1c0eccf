#include <cstdint>

#include "fuzz/try_drawing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tenon::fuzz::try_drawing({"fuzz" TENON_FUZZ_ENDING, std::string(reinterpret_cast<const char*>(data), size)});
  return 0;
}
