#include "coordinator/lease_signer.h"

#include <sodium.h>
#include <algorithm>
#include <cstring>
#include <string>

#include "base/assert.h"

namespace swarmsmith {
namespace {

static_assert(sizeof(LeaseSecret) == crypto_shorthash_KEYBYTES);

constexpr std::size_t kWord = 8;
/// Longest name of a principal that is signed as it is.
constexpr std::size_t kMostName = 128;
/// No attempt has this number, so that no draw is a signature.
constexpr std::int64_t kDraw = -1;

void put_word(unsigned char* bytes, std::uint64_t word) {
  for (std::size_t i = 0; i < kWord; ++i)
    bytes[i] = static_cast<unsigned char>(word >> (8 * i));
}

}  // namespace

std::uint64_t LeaseSigner::sign(PackedKey key, std::int64_t attempt,
                                std::string_view principal) const {
  std::array<unsigned char, 2 * kWord + kMostName> bytes;
  const std::size_t name = std::min(principal.size(), kMostName);
  put_word(bytes.data(), key);
  put_word(bytes.data() + kWord, static_cast<std::uint64_t>(attempt));
  if (name > 0) std::memcpy(bytes.data() + 2 * kWord, principal.data(), name);
  std::array<unsigned char, crypto_shorthash_BYTES> hash;
  crypto_shorthash(hash.data(), bytes.data(), 2 * kWord + name, secret_.data());
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < kWord; ++i)
    word |= static_cast<std::uint64_t>(hash[i]) << (8 * i);
  return word != 0 ? word : 1;
}

std::uint64_t LeaseSigner::draw(PackedKey key) const {
  return sign(key, kDraw, {});
}

LeaseSecret lease_secret_of(std::string_view lasting, std::uint64_t scenario) {
  SWARMSMITH_ASSERT(sodium_init() >= 0, "libsodium works");
  std::array<unsigned char, kWord> bytes;
  put_word(bytes.data(), scenario);
  const std::string text = std::string("swarmsmith leases ") + std::string(lasting);
  LeaseSecret secret{};
  crypto_generichash_state state;
  crypto_generichash_init(&state, nullptr, 0, secret.size());
  crypto_generichash_update(&state, bytes.data(), bytes.size());
  crypto_generichash_update(&state, reinterpret_cast<const unsigned char*>(text.data()),
                            text.size());
  crypto_generichash_final(&state, secret.data(), secret.size());
  return secret;
}

std::string random_secret() {
  SWARMSMITH_ASSERT(sodium_init() >= 0, "libsodium works");
  std::array<unsigned char, 32> bytes;
  randombytes_buf(bytes.data(), bytes.size());
  std::string text(2 * bytes.size() + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
  text.pop_back();
  return text;
}

bool same_secret(std::string_view one, std::string_view other) {
  return !one.empty() && one.size() == other.size() &&
         sodium_memcmp(one.data(), other.data(), one.size()) == 0;
}

}  // namespace swarmsmith
