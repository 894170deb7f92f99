// Between libFuzzer and a target.

#include <cstdint>

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  swarmsmith::fuzz::run({reinterpret_cast<const char*>(data), size});
  return 0;
}
