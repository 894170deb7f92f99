#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <tl/expected.hpp>

#include "base/process/interrupt.h"
#include "base/process/process.h"
#include "programs/command_line.h"
#include "programs/failure_details.h"
#include "programs/output.h"
#include "programs/target.h"

namespace swarmsmith {

/// What came of an evaluation by programs.
struct TargetResult {
  Reading reading;
  bool rejected = false;  ///< an infinite cost, or a time-out that counts as one

  friend bool operator==(const TargetResult&, const TargetResult&) = default;
};

/// Why there is none.
struct TargetFailure {
  std::string reason;  ///< a sentence
  FailureDetails details;
  bool timed_out = false;
  /// A signal from elsewhere ended the program: perhaps one that was meant for the whole host.
  bool from_outside = false;
};

struct RunnerOptions {
  /// The file behind a program's name, looked up and checked anew before each start: that file is
  /// run, whatever the name means a moment later. Without it a program is run by its name.
  std::function<Expected<std::string>(const std::string& program)> file_of{};
  /// Whether texts that only a shell understands are given to one.
  bool shell = false;
  std::chrono::milliseconds batch_poll = std::chrono::seconds(2);
  std::chrono::milliseconds term_grace = std::chrono::seconds(1);
  std::size_t longest_text = 4000;  ///< bytes of each text of a failure
};

/// Calls the programs of a target, one evaluation after the other; one object a thread. `interrupt`
/// ends what runs, and must outlive it.
class TargetRunner {
 public:
  TargetRunner(Target target, RunnerOptions options, const Interrupt& interrupt);

  /// One run: the call, again at once as often as `retries` allows when it fails (irace facts,
  /// 18.3); in batch mode its job to the end.
  tl::expected<TargetResult, TargetFailure> run(const RunnerCall& call) const;
  /// The cost of a configuration whose runs are done.
  tl::expected<TargetResult, TargetFailure> evaluate(const EvaluatorCall& call) const;

 private:
  /// A command as it is run, and as people would type it.
  struct Command {
    ProcessCall process;
    std::string text;
  };
  tl::expected<Command, TargetFailure> command(const std::string& program,
                                               const std::string& arguments) const;
  tl::expected<Command, TargetFailure> runner_command(const RunnerCall& call) const;
  tl::expected<ProcessEnd, TargetFailure> call(const Command& command,
                                               const std::string& role) const;
  tl::expected<TargetResult, TargetFailure> run_once(const Command& command, double bound) const;
  TargetFailure failure(const Command& command, const ProcessEnd* end, std::string reason) const;

  Target target_;
  RunnerOptions options_;
  const Interrupt* interrupt_;
};

/// What a person reads who must know why an evaluation failed: reason, the exact call, what it
/// wrote, and what to do (irace facts, 18.3).
std::string message_of(const std::string& reason, const FailureDetails& details);

}  // namespace swarmsmith
