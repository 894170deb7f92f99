#pragma once

#include <sys/types.h>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/expected.h"
#include "base/rng.h"

namespace swarmsmith {

/// A child process in its own group: Ctrl-C at the terminal reaches only the coordinator, which
/// then drains. It is killed and reaped when this object is destroyed.
class ChildProcess {
 public:
  enum class Streams {
    Inherited,
    /// Its input ends when this object or this process ends; this object reads its error output.
    Held,
    /// Its input ends as with Held; the owner of this object reads its output. Both descriptors
    /// block.
    Spoken,
  };

  ChildProcess() = default;
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Starts `words[0]`, which is looked up in PATH if it has no slash, with further variables
  /// ("NAME=value") in its environment. No process of this object may be running.
  Expected<void> start(const std::vector<std::string>& words, Streams streams,
                       const std::vector<std::string>& variables = {});

  bool runs() const { return pid_ > 0; }
  pid_t pid() const { return pid_; }
  /// Its status from waitpid, which is returned once after its end.
  std::optional<int> ended();
  void signal(int number) const;
  void end_input();
  /// Descriptors of a process with Spoken streams; -1 after its end.
  int input() const { return input_; }
  int output() const { return output_; }
  /// The last line of its error output so far; empty for none. Drops the lines that it reads.
  const std::string& last_line();
  /// The lines of its error output since the last call, without those that `last_line` has read.
  /// Each has at most 500 characters.
  std::vector<std::string> take_lines();
  /// Waits for its end until `until`; after that, kills it with SIGKILL.
  void finish_by(TimePoint until);

 private:
  /// Reads its error output so far, and gives each line to `lines_` if lines are wanted.
  void read_lines(bool wanted);
  void end_line(bool wanted);
  void close_streams();

  pid_t pid_ = 0;
  int input_ = -1;
  int output_ = -1;
  int errors_ = -1;
  std::string line_;       ///< the line that is not complete yet
  std::string last_line_;  ///< the last one that is not blank
  std::vector<std::string> lines_;
};

/// Pauses before a retry: doubling from `first` to `longest`, plus or minus a random quarter, so
/// that many clients that failed together do not return together.
class Backoff {
 public:
  Backoff(Duration first, Duration longest, Rng jitter)
      : first_(first), longest_(longest), jitter_(jitter) {}

  Duration next();
  void reset() { pause_ = {}; }

 private:
  Duration first_;
  Duration longest_;
  Rng jitter_;
  Duration pause_{};
};

}  // namespace swarmsmith
