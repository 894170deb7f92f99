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

/// The result of an evaluation by programs.
struct TargetResult {
  Reading reading;
  bool rejected = false;  ///< an infinite cost, or a time-out that counts as infinite

  friend bool operator==(const TargetResult&, const TargetResult&) = default;
};

/// Why an evaluation has no result.
struct TargetFailure {
  std::string reason;  ///< one sentence
  FailureDetails details;
  bool timed_out = false;
  /// A signal from another process ended the program; it may have been meant for the whole host.
  bool from_outside = false;
};

struct RunnerOptions {
  /// Returns the file for a program's name, looked up and checked before each start. Exactly that
  /// file is run, even if the name refers to another file a moment later. If empty, programs are
  /// run by name.
  std::function<Expected<std::string>(const std::string& program)> file_of{};
  /// Whether command lines that need a shell are given to one.
  bool shell = false;
  std::chrono::milliseconds batch_poll = std::chrono::seconds(2);
  std::chrono::milliseconds term_grace = std::chrono::seconds(1);
  std::size_t longest_text = 4000;  ///< bytes of each text of a failure
};

/// Calls the programs of a target, one evaluation after the other; use one object per thread.
/// `interrupt` ends running programs, and must outlive this object.
class TargetRunner {
 public:
  TargetRunner(Target target, RunnerOptions options, const Interrupt& interrupt);

  /// One run: calls the targetRunner, and repeats a failed call at most `retries` times (irace
  /// facts, 18.3). In batch mode, waits for the end of its job.
  tl::expected<TargetResult, TargetFailure> run(const RunnerCall& call) const;
  /// The cost of a configuration whose runs have ended.
  tl::expected<TargetResult, TargetFailure> evaluate(const EvaluatorCall& call) const;

 private:
  /// A command to run, and its text as a user would type it.
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

/// An explanation of a failed evaluation: the reason, the exact call, its output, and advice (irace
/// facts, 18.3).
std::string message_of(const std::string& reason, const FailureDetails& details);

}  // namespace swarmsmith
