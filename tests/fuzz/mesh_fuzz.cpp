#include <cstdint>

#include "fuzz/try_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tenon::fuzz::try_mesh({"fuzz" TENON_FUZZ_ENDING, std::string(reinterpret_cast<const char*>(data), size)});
  return 0;
}
