#pragma once

#include <cstdint>

#include "benchmarks/cluster/recorded_races.h"

namespace swarmsmith::bench {

/// A model of a pool of workers and its coordinator: events on a simulated clock. It includes what
/// slows down a real pool: tests that wait for their last evaluation, the time of messages, workers
/// that hold more evaluations than they run, and the coordinator's one thread. The rules for leases
/// are those of the scheduler: credit for 20 ms of work, no more than half a share of the remaining
/// queue, the design that is nearest to its test first, and look-ahead only for idle slots.
struct ModelShape {
  std::int64_t slots = 64;         ///< of the pool
  std::int64_t worker_slots = 64;  ///< of each worker, at most
  double us = 5'000;               ///< mean time of an evaluation
  double spread = 0.3;             ///< times are uniform within +- this fraction of it
  double latency_us = 100;         ///< of a message
  // Times on the coordinator's main thread:
  double wake_us = 8;     ///< to wake up for a message
  double message_us = 4;  ///< for a message with results
  double result_us = 2;   ///< for each result in it
  double test_us = 60;    ///< for a test, and the next tasks
};

struct ModelRun {
  double wall_s = 0;
  double efficiency = 0;  ///< evaluations that count x time / (slots x wall time)
  double extra = 0;  ///< number of evaluations that do not count, as a fraction of those that do
};

/// Runs the designs to their end.
ModelRun run_model(const ModelShape& shape, RecordedRaces& source);

}  // namespace swarmsmith::bench
