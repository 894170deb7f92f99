#pragma once

#include <cstdint>

#include "benchmarks/cluster/recorded_races.h"

namespace swarmsmith::bench {

/// A pool of workers and its coordinator, as a model: events on a simulated clock. What holds a
/// real one up is in it: tests that wait for their last evaluation, messages that take their time,
/// workers that hold more than they run, the coordinator's one thread. Rules of leasing are those
/// of the scheduler: credit for 20 ms of work, no more than half a share of the remaining queue,
/// the design that is next to its test first, looking ahead only for slots that idle.
struct ModelShape {
  std::int64_t slots = 64;         ///< of the pool
  std::int64_t worker_slots = 64;  ///< of each worker at most
  double us = 5'000;               ///< mean time of an evaluation
  double spread = 0.3;             ///< times are even within +- this part
  double latency_us = 100;         ///< of a message
  // Of the coordinator's main thread.
  double wake_us = 8;     ///< a message that finds it asleep
  double message_us = 4;  ///< a message with results
  double result_us = 2;   ///< a result in it
  double test_us = 60;    ///< a test, and the next tasks
};

struct ModelRun {
  double wall_s = 0;
  double efficiency = 0;  ///< evaluations that count x time / (slots x wall time)
  double extra = 0;       ///< evaluations that do not count, as a part of those that do
};

/// Runs the designs to their end.
ModelRun run_model(const ModelShape& shape, RecordedRaces& source);

}  // namespace swarmsmith::bench
