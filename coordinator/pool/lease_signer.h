#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "coordinator/design/task.h"
#include "proto/key.h"

namespace swarmsmith {

/// 16 bytes that only the coordinator knows.
using LeaseSecret = std::array<unsigned char, 16>;

/// Signs leases, so that a result can show that its sender was given the task: by this process or,
/// with the same secret, by one that crashed. SipHash-2-4 (libsodium's crypto_shorthash), 8 bytes.
class LeaseSigner {
 public:
  explicit LeaseSigner(const LeaseSecret& secret) : secret_(secret) {}

  /// Of the lease of a task to a principal (principal.h); never 0, which stands for none. 16 bits
  /// of it are a mark of what is to be evaluated: after a crash that took a lie with it, another
  /// machine may have the key.
  std::uint64_t sign(const Task& task, std::int64_t attempt, std::string_view principal) const;
  /// Whether the signature is of some lease of that key.
  bool is_ours(std::uint64_t signature, PackedKey key, std::int64_t attempt,
               std::string_view principal) const;
  /// Whether one of ours is of a lease of this very task.
  bool is_of(std::uint64_t signature, const EvaluationInput& task) const;
  /// A number of 64 uniform bits that cannot be foretold without the secret.
  std::uint64_t draw(PackedKey key) const;

 private:
  std::uint64_t hash(std::span<const unsigned char> bytes) const;
  std::uint64_t sign(PackedKey key, std::int64_t attempt, std::string_view principal,
                     std::uint64_t mark) const;
  std::uint64_t mark_of(const EvaluationInput& task) const;

  LeaseSecret secret_;
};

/// The secret of a pool of campaigns, from one that lasts: two scenarios have different ones.
LeaseSecret lease_secret_of(std::string_view lasting, std::uint64_t scenario);
/// From the system's random bytes; as text, in hexadecimal.
std::string random_secret();
/// In a time that does not tell where they differ; false when either is empty.
bool same_secret(std::string_view one, std::string_view other);

}  // namespace swarmsmith
