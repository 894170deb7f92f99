#pragma once

#include <sys/types.h>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "base/expected.h"
#include "base/rng.h"

namespace swarmsmith {

/// A process of this one, in a group of its own: Ctrl-C at the terminal is for the coordinator,
/// which then drains. Killed and reaped with the object.
class ChildProcess {
 public:
  enum class Streams {
    Inherited,
    /// Its input ends when this object or this process does, and its errors are read by it.
    Held,
    /// Its input ends as with Held, and its output is read by whoever has this object; both block.
    Spoken,
  };

  ChildProcess() = default;
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Starts `words[0]`, looked for in PATH when its name has no slash, with further variables
  /// ("NAME=value") in its environment. None may run yet.
  Expected<void> start(const std::vector<std::string>& words, Streams streams,
                       const std::vector<std::string>& variables = {});

  bool runs() const { return pid_ > 0; }
  pid_t pid() const { return pid_; }
  /// Its status as of waitpid, once, when it has ended.
  std::optional<int> ended();
  void signal(int number) const;
  void end_input();
  /// Descriptors of a Spoken one; -1 when it has ended.
  int input() const { return input_; }
  int output() const { return output_; }
  /// The last line that it has written to its errors so far; empty for none.
  const std::string& last_line();
  /// Waits for its end until then, and ends it with SIGKILL after that.
  void finish_by(TimePoint until);

 private:
  void close_streams();

  pid_t pid_ = 0;
  int input_ = -1;
  int output_ = -1;
  int errors_ = -1;
  std::string line_;       ///< the one that is being written
  std::string last_line_;  ///< not blank
};

/// Pauses before something is tried again: doubling from `first` to `longest`, and a quarter more
/// or less by chance, so that many who failed together do not come back together.
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
