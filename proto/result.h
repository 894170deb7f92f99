#pragma once

#include <cstdint>
#include <string>

#include "base/measured.h"
#include "programs/failure_details.h"
#include "proto/key.h"

namespace swarmsmith {

/// The result of one evaluation: a score, a rejection, or the reason why there is neither.
struct Result {
  PackedKey key = 0;  ///< also identifies the campaign
  std::int64_t attempt = 0;
  Measured measured{};
  bool rejected = false;  ///< the target rejected the configuration: neither a score nor a failure
  std::string failure{};  ///< empty when there is a score or a rejection
  FailureDetails details{};     ///< of a failed target
  std::uint64_t signature = 0;  ///< of the lease under which it ran
};

}  // namespace swarmsmith
