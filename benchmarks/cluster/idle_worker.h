#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/clock.h"
#include "base/expected.h"
#include "proto/curve.h"

namespace swarmsmith::bench {

/// The work of a benchmark's workers instead of a simulation. Its text is the scenario.
struct Work {
  enum class Kind { Spin, Sleep } kind = Kind::Spin;
  std::int64_t us = 0;  ///< mean time of an evaluation
  /// Times are uniform within `us` +- this fraction of it; the task's seed selects them.
  double spread = 0;
};
std::string to_text(const Work& work);
Expected<Work> work_of(const std::string& text);
/// The time that the evaluation with this seed takes.
Duration time_of(const Work& work, std::int64_t seed);

/// The form of a benchmark's worker processes. A single worker is the service of swarmsmith-worker,
/// with its threads; several in one process are a crowd (crowd.h).
struct WorkerShape {
  int workers = 1;
  int slots = 1;  ///< of each worker
};

/// Makes later children of this program workers of this shape, which connect to `endpoint`, with
/// keys if there are any. The settings are passed in the environment.
void announce(const std::string& endpoint, const WorkerShape& shape,
              const std::optional<ClientKeys>& keys);
/// Whether this process is such a child. Must be called first in main.
bool is_worker();
/// Works until the campaign is over. Scores follow from machine and seed.
[[noreturn]] void be_worker();

/// The score of an evaluation: one half depends on the machine, the other on the seed.
double synthetic_score(const std::string& machine, std::int64_t seed);

}  // namespace swarmsmith::bench
