#include "base/hash.h"

#include <fmt/format.h>
#include <cstring>

namespace swarmsmith {

void Digest::add(std::uint64_t word) {
  ++words_;
  state_[0] = mix64(state_[0] ^ word) + words_;
  state_[1] = mix64(state_[1] + std::rotl(word, 32) + state_[0]);
}

void Digest::add(std::string_view text) {
  add(static_cast<std::uint64_t>(text.size()));
  for (std::size_t at = 0; at < text.size(); at += 8) {
    std::uint64_t word = 0;
    for (std::size_t byte = 0; byte < 8 && at + byte < text.size(); ++byte) {
      word |= static_cast<std::uint64_t>(static_cast<unsigned char>(text[at + byte])) << (8 * byte);
    }
    add(word);
  }
}

std::uint64_t Digest::value64() const {
  return mix64(state_[0] ^ std::rotl(state_[1], 17));
}

std::string Digest::hex() const {
  return fmt::format("{:016x}{:016x}", value64(), mix64(state_[1] + words_));
}

}  // namespace swarmsmith
