#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/process/interrupt.h"

namespace swarmsmith {

/// A program that is to run, and how long.
struct ProcessCall {
  /// Program and arguments. A program without a slash in its name is looked for in PATH.
  std::vector<std::string> words;
  /// The file that is run under the name `words[0]`; empty: the one that this name means.
  std::string file{};
  std::string folder;                 ///< in which it runs; empty: where this process is
  std::chrono::milliseconds limit{};  ///< 0 for none
  /// Between SIGTERM and SIGKILL.
  std::chrono::milliseconds term_grace{1000};
  /// After the program's end, for what it left behind to close the output.
  std::chrono::milliseconds pipe_grace{500};
  std::size_t keep = std::size_t{64} << 10U;  ///< bytes of each output that are kept, the last ones
};

/// What a program wrote to one of its outputs.
struct Captured {
  std::string text;        ///< the end of it, when it is long
  std::uint64_t size = 0;  ///< bytes in all
  bool complete() const { return size == text.size(); }
};

/// How a program ended, and what it wrote.
struct ProcessEnd {
  enum class Why { Itself, Limit, Interrupted };
  Why why = Why::Itself;  ///< the others: it was ended
  int exit_code = 0;      ///< when no signal ended it
  int signal = 0;         ///< that ended it; 0 for none
  Captured output;
  Captured errors;
};

/// Runs a program and waits for its end. Any number of threads may do so at once.
///
/// It has a process group of its own, /dev/null as its input, and none of this process's
/// descriptors. When the time is over or `interrupt` triggers, the whole group gets SIGTERM and
/// then SIGKILL; when it ends by itself, what it left behind in its group gets SIGKILL. When the
/// calling thread or this process dies, the program is ended by the kernel, and its group by the
/// guard (base/process/guard.h). A script without #! is run by /bin/sh, as shells do it.
///
/// Errors: a program that cannot be started, and why.
Expected<ProcessEnd> run_process(const ProcessCall& call, const Interrupt& interrupt);

/// The file that a program's name means: itself when it has a slash, else the first in PATH that
/// may be run.
Expected<std::string> find_program(const std::string& name);

}  // namespace swarmsmith
