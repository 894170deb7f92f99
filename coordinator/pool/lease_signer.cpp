#include "coordinator/pool/lease_signer.h"

#include <sodium.h>
#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "base/assert.h"
#include "coordinator/pool/task_key.h"

namespace swarmsmith {
namespace {

static_assert(sizeof(LeaseSecret) == crypto_shorthash_KEYBYTES);

constexpr std::size_t kWord = 8;
/// The longest part of a principal's name that is signed.
constexpr std::size_t kMostName = 128;
/// How many of a signature's 64 bits are the mark.
constexpr int kMarkBits = 16;
/// No attempt has this number, and signed texts are longer, so no draw equals a signature.
constexpr std::uint64_t kDraw = ~std::uint64_t{0};

void put_word(unsigned char* bytes, std::uint64_t word) {
  for (std::size_t i = 0; i < kWord; ++i)
    bytes[i] = static_cast<unsigned char>(word >> (8 * i));
}

}  // namespace

std::uint64_t LeaseSigner::hash(std::span<const unsigned char> bytes) const {
  std::array<unsigned char, crypto_shorthash_BYTES> hash;
  crypto_shorthash(hash.data(), bytes.data(), bytes.size(), secret_.data());
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < kWord; ++i)
    word |= static_cast<std::uint64_t>(hash[i]) << (8 * i);
  return word;
}

std::uint64_t LeaseSigner::sign(PackedKey key, std::int64_t attempt, std::string_view principal,
                                std::uint64_t mark) const {
  std::array<unsigned char, 3 * kWord + kMostName> bytes;
  const std::size_t name = std::min(principal.size(), kMostName);
  // Words of fixed size come first and the name last, so two different leases never give the same
  // text (for names of up to kMostName bytes).
  put_word(bytes.data(), key);
  put_word(bytes.data() + kWord, static_cast<std::uint64_t>(attempt));
  put_word(bytes.data() + 2 * kWord, mark);
  if (name > 0) std::memcpy(bytes.data() + 3 * kWord, principal.data(), name);
  const std::uint64_t word = hash({bytes.data(), 3 * kWord + name}) >> kMarkBits;
  // The mark stays readable, so `is_of` can compare it without knowing attempt and principal. 0
  // means "no signature", hence at least 1.
  return std::max<std::uint64_t>(word, 1) | mark << (64 - kMarkBits);
}

std::uint64_t LeaseSigner::mark_of(const EvaluationInput& task) const {
  std::array<unsigned char, 5 * kWord> words;
  // The input of the evaluation; its profile follows from the key. After a crash, the same key may
  // be another machine (decision 19).
  put_word(words.data(), static_cast<std::uint64_t>(task.mission) << 32 | task.method);
  put_word(words.data() + kWord, static_cast<std::uint64_t>(task.instance));
  put_word(words.data() + 2 * kWord, static_cast<std::uint64_t>(task.seed));
  put_word(words.data() + 3 * kWord, std::bit_cast<std::uint64_t>(task.bound));
  put_word(
      words.data() + 4 * kWord,
      hash({reinterpret_cast<const unsigned char*>(task.machine.data()), task.machine.size()}));
  return hash(words) >> (64 - kMarkBits);
}

std::uint64_t LeaseSigner::sign(const Task& task, std::int64_t attempt,
                                std::string_view principal) const {
  return sign(key_of(task), attempt, principal, mark_of(task));
}

bool LeaseSigner::is_ours(std::uint64_t signature, PackedKey key, std::int64_t attempt,
                          std::string_view principal) const {
  return signature != 0 &&
         // With the mark that the signature itself has: the result may be of a task whose record is
         // gone.
         signature == sign(key, attempt, principal, signature >> (64 - kMarkBits));
}

bool LeaseSigner::is_of(std::uint64_t signature, const EvaluationInput& task) const {
  return signature >> (64 - kMarkBits) == mark_of(task);
}

std::uint64_t LeaseSigner::draw(PackedKey key) const {
  std::array<unsigned char, 2 * kWord> words;
  put_word(words.data(), key);
  put_word(words.data() + kWord, kDraw);
  return hash(words);
}

LeaseSecret lease_secret_of(std::string_view lasting, std::uint64_t scenario) {
  SWARMSMITH_ASSERT(sodium_init() >= 0, "libsodium works");
  std::array<unsigned char, kWord> bytes;
  // Signatures of one scenario are worthless in another one.
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
