#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/expected.h"
#include "base/process/interrupt.h"

namespace swarmsmith {

/// A program to run, and its time limit.
struct ProcessCall {
  /// Program and arguments. A program whose name has no slash is looked up in PATH.
  std::vector<std::string> words;
  /// The file to run under the name `words[0]`; empty: the file with that name.
  std::string file{};
  std::string folder;                 ///< working folder; empty: the folder of this process
  std::chrono::milliseconds limit{};  ///< 0 for none
  /// Time between SIGTERM and SIGKILL.
  std::chrono::milliseconds term_grace{1000};
  /// Time after the program's end for its remaining processes to close the output.
  std::chrono::milliseconds pipe_grace{500};
  std::size_t keep = std::size_t{64}
                     << 10U;  ///< number of bytes that are kept of each output, from its end
};

/// The output of a program on one of its streams.
struct Captured {
  std::string text;        ///< only the end of the output, if it is long
  std::uint64_t size = 0;  ///< total number of bytes
  bool complete() const { return size == text.size(); }
};

/// How a program ended, and its output.
struct ProcessEnd {
  enum class Why { Itself, Limit, Interrupted };
  Why why = Why::Itself;  ///< Limit, Interrupted: this process ended it
  int exit_code = 0;      ///< valid when no signal ended it
  int signal = 0;         ///< the signal that ended it; 0 for none
  Captured output;
  Captured errors;
};

/// Runs a program and waits for its end. Any number of threads may do so at the same time.
///
/// The program has its own process group, /dev/null as its input, and none of this process's
/// descriptors. When the time is over or `interrupt` triggers, the whole group gets SIGTERM and
/// then SIGKILL. When it ends normally, the rest of its group gets SIGKILL. When the calling thread
/// or this process dies, the kernel ends the program, and the guard ends its group
/// (base/process/guard.h). /bin/sh runs a script without #!, as in shells.
///
/// Errors: a program that cannot be started, with the reason.
Expected<ProcessEnd> run_process(const ProcessCall& call, const Interrupt& interrupt);

/// The file of a program: the name itself if it has a slash, else the first executable in PATH.
Expected<std::string> find_program(const std::string& name);

}  // namespace swarmsmith
