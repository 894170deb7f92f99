#pragma once

#include <cstdint>

#include "storage/real_runs.h"

namespace swarmsmith {

/// A real run that was never filmed, with rows of every kind: two cameras, two robots that walk in
/// circles for `cycles`, floor tags, an unknown tag, patches, issues. A function of its arguments;
/// seeds are different videos.
RealRunRows synthetic_real_run(std::uint64_t seed, CandidateId candidate, std::int64_t cycles = 40);

}  // namespace swarmsmith
