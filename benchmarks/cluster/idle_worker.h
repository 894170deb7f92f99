#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/clock.h"
#include "base/expected.h"
#include "proto/curve.h"

namespace swarmsmith::bench {

/// What the workers of a benchmark do in place of a simulation. The text of it is the scenario.
struct Work {
  enum class Kind { Spin, Sleep } kind = Kind::Spin;
  std::int64_t us = 0;  ///< mean time of an evaluation
  /// Times are even within `us` +- this part of it, by the task's seed.
  double spread = 0;
};
std::string to_text(const Work& work);
Expected<Work> work_of(const std::string& text);
/// How long the evaluation with that seed takes.
Duration time_of(const Work& work, std::int64_t seed);

/// How a benchmark's worker processes look. One worker is the service of swarmsmith-worker, with
/// its threads; more of them in one process are a crowd (crowd.h).
struct WorkerShape {
  int workers = 1;
  int slots = 1;  ///< of each
};

/// Makes this program's later children workers of that shape, which connect to `endpoint`, with
/// keys if there are any. The environment tells them.
void announce(const std::string& endpoint, const WorkerShape& shape,
              const std::optional<ClientKeys>& keys);
/// Whether this process is such a child. To be asked first of all in main.
bool is_worker();
/// Until the campaign is over. Scores are made of machine and seed.
[[noreturn]] void be_worker();

/// The score of an evaluation: half of it is the machine's own, half the seed's.
double synthetic_score(const std::string& machine, std::int64_t seed);

}  // namespace swarmsmith::bench
