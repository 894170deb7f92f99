#include "base/rng.h"

#include "base/assert.h"
#include "base/math.h"

namespace swarmsmith {

Rng Rng::split(std::string_view name, std::uint64_t index) const {
  Digest digest;
  digest.add(key_);
  digest.add(name);
  digest.add(index);
  return Rng(digest.value64());
}

std::uint64_t Rng::below(std::uint64_t n) {
  SWARMSMITH_ASSERT(n > 0, "a draw needs at least one outcome");
  // The largest multiple of n that fits; numbers above it are drawn again.
  const std::uint64_t limit = ~std::uint64_t{0} - (~std::uint64_t{0} % n + 1) % n;
  std::uint64_t x = next();
  while (x > limit)
    x = next();
  return x % n;
}

double Rng::normal() {
  // Midpoints of 2^53 cells: never 0 or 1, symmetric about one half.
  return normal_quantile((static_cast<double>(next() >> 11U) + 0.5) * 0x1.0p-53);
}

}  // namespace swarmsmith
