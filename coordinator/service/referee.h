#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coordinator/pool/scheduler_types.h"

namespace swarmsmith {

/// Evaluates where no worker's word is enough. An abstract class because tests put an honest one of
/// their own behind it.
class Referee {
 public:
  virtual ~Referee() = default;

  /// One at a time: the next one after the ruling on this. Waits for nothing.
  virtual void judge(AskReferee ask) = 0;
  /// What came since the last call.
  virtual std::vector<Ruling> take_rulings() = 0;
};

struct RefereeOptions {
  std::string scenario;  ///< serialised
  int engine_version = 0;
  std::string self_test;              ///< that its process must give
  std::filesystem::path program{};    ///< empty: `find_worker_program`
  std::function<void()> on_ruling{};  ///< from another thread
};

/// A referee that is a child process of this one: `swarmsmith-worker --referee` (worker/referee.h),
/// with a pipe to it and nothing else. It is started with the first evaluation, and again when it
/// ended. A ruling is
///
/// - a score, or Rejected when the process says that there is none, or dies of the evaluation twice
///   by a signal that a fault of the program raises;
/// - TimedOut when it takes longer than it may;
/// - NoWord when the process cannot be had, is of another build, ends before it began, runs out of
///   memory, or is killed by another process three times: then it is this host that has to be
///   mended.
std::unique_ptr<Referee> make_process_referee(RefereeOptions options);

}  // namespace swarmsmith
