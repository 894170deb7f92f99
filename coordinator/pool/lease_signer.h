#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "coordinator/design/task.h"
#include "proto/key.h"

namespace swarmsmith {

/// 16 bytes that are known only to the coordinator.
using LeaseSecret = std::array<unsigned char, 16>;

/// Signs leases, so that a result proves that its sender was given the task: by this process or,
/// with the same secret, by an earlier process that crashed. SipHash-2-4 (libsodium's
/// crypto_shorthash), 8 bytes.
class LeaseSigner {
 public:
  explicit LeaseSigner(const LeaseSecret& secret) : secret_(secret) {}

  /// The signature of the lease of a task to a principal (principal.h); never 0, which means no
  /// signature. 16 of its bits are a mark of the evaluation's input, because after a crash that
  /// lost a false result, the same key may mean another machine.
  std::uint64_t sign(const Task& task, std::int64_t attempt, std::string_view principal) const;
  /// Whether the signature belongs to a lease of that key.
  bool is_ours(std::uint64_t signature, PackedKey key, std::int64_t attempt,
               std::string_view principal) const;
  /// Whether one of our signatures belongs to a lease of exactly this task.
  bool is_of(std::uint64_t signature, const EvaluationInput& task) const;
  /// A number of 64 uniform bits that cannot be predicted without the secret.
  std::uint64_t draw(PackedKey key) const;

 private:
  std::uint64_t hash(std::span<const unsigned char> bytes) const;
  std::uint64_t sign(PackedKey key, std::int64_t attempt, std::string_view principal,
                     std::uint64_t mark) const;
  std::uint64_t mark_of(const EvaluationInput& task) const;

  LeaseSecret secret_;
};

/// The secret of a pool of campaigns, from a permanent secret; it differs between scenarios.
LeaseSecret lease_secret_of(std::string_view lasting, std::uint64_t scenario);
/// A secret from the system's random bytes, as hexadecimal text.
std::string random_secret();
/// Compares in a time that does not reveal where the two differ; false if one is empty.
bool same_secret(std::string_view one, std::string_view other);

}  // namespace swarmsmith
