#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coordinator/pool/scheduler_types.h"

namespace swarmsmith {

/// Evaluates again where a worker's result is not enough. This class is abstract so that tests can
/// use their own honest referee.
class Referee {
 public:
  virtual ~Referee() = default;

  /// Starts an evaluation without waiting for it. Call again only after the ruling on it.
  virtual void judge(AskReferee ask) = 0;
  /// The rulings since the last call.
  virtual std::vector<Ruling> take_rulings() = 0;
};

struct RefereeOptions {
  std::string scenario;  ///< serialised
  int engine_version = 0;
  std::string self_test;              ///< the answer that the referee's process must give
  std::filesystem::path program{};    ///< empty: `find_worker_program`
  std::function<void()> on_ruling{};  ///< called from another thread
};

/// A referee that is a child process: `swarmsmith-worker --referee` (worker/referee.h), connected
/// only by a pipe. It is started with the first evaluation, and again after it has ended. A ruling
/// is one of these:
///
/// - a score, or Rejected when the process reports that there is no score, or when the evaluation
///   kills it twice by a signal that a fault of the program raises;
/// - TimedOut when the evaluation takes longer than its limit;
/// - NoWord when the process cannot be started, is of another build, ends before the evaluation
///   began, runs out of memory, or is killed by another process three times: then this host needs
///   repair.
std::unique_ptr<Referee> make_process_referee(RefereeOptions options);

}  // namespace swarmsmith
