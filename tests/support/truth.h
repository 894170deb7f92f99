#pragma once

#include <cstdint>

namespace swarmsmith::cluster {

/// What an evaluation does, in a campaign of the tests.
struct Truth {
  enum class Kind {
    Score,
    Fails,  ///< always says that there is no score
    Kills,  ///< always kills its worker
  };
  Kind kind = Kind::Score;
  double score = 0;
  std::uint64_t state_digest = 0;
};

}  // namespace swarmsmith::cluster
