#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace swarmsmith {

/// Two rounds of multiply and xor-shift that spread every bit of `x` over the word: the output
/// function of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators",
/// OOPSLA 2014).
constexpr std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

/// An order-dependent 128-bit digest of a stream of words and texts, the same on every machine. It
/// finds differences and damage, but does not protect against changes on purpose.
class Digest {
 public:
  void add(std::uint64_t word);
  void add(std::int64_t word) { add(static_cast<std::uint64_t>(word)); }
  void add(std::int32_t word) { add(static_cast<std::uint64_t>(word)); }
  /// Adds the bits of the value: -0 and 0 differ.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  /// Adds the length first, so that ("ab", "c") and ("a", "bc") differ.
  void add(std::string_view text);
  void add(const char* text) { add(std::string_view(text)); }

  /// The low word, which is enough for tables with one integer.
  std::uint64_t value64() const;
  /// 32 hexadecimal digits.
  std::string hex() const;

 private:
  std::array<std::uint64_t, 2> state_{0x243f6a8885a308d3U, 0x13198a2e03707344U};
  std::uint64_t words_ = 0;
};

}  // namespace swarmsmith
