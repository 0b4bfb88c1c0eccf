#include <cstdint>

#include "fuzz/try_drawing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const tenon::InputFile file{"fuzz" TENON_FUZZ_ENDING, std::string(reinterpret_cast<const char*>(data), size)};
  tenon::ending_of(file.path) == ".svg" ? tenon::fuzz::try_svg(file) : tenon::fuzz::try_drawing(file);
  return 0;
}
