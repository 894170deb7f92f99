#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "console/complete.h"
#include "console/declared.h"
#include "console/options.h"

namespace swarmsmith {

/// Runs a command after its arguments are parsed.
using CommandRun = std::function<ExitCode(Output&)>;

/// One command of a program.
struct ProgramCommand {
  std::string_view name;     ///< one or two words: "calibrate camera"
  std::string_view summary;  ///< one line
  std::string_view details;  ///< examples and other useful facts, printed below the options
  /// Declares the command's options and returns the function to call after parsing.
  CommandRun (*declare)(Options& options) = nullptr;
  /// Instead of `declare`, for a command that parses its own arguments, help and flags.
  ExitCode (*run_words)(const std::vector<std::string>& words, Output& output) = nullptr;
  /// Changes the arguments before they are parsed.
  std::vector<std::string> (*prepare)(std::vector<std::string> words) = nullptr;
  /// For a command with `run_words`: its options. If this is null, `run_words` becomes another
  /// program, which declares its own options.
  std::vector<DeclaredOption> (*options)() = nullptr;
};

/// A program with a command line for people.
struct Program {
  std::string_view name;     ///< "swarmsmith"
  std::string_view purpose;  ///< one sentence, the first line of its help
  std::span<const ProgramCommand> commands;
  std::string_view begin;  ///< last lines of its help: where newcomers should begin
  OfferValues values = nullptr;
};

/// Runs the program with the arguments after its name. Output goes to `output`, whose flags
/// (`--json`, `--quiet`, `-v`, `--no-color`) are read first. Wrong usage is explained on the error
/// stream. Two first arguments are for scripts and not in the help: `--declared` prints the
/// commands and all their options as JSON; `--complete WORD...` prints completions of the last word
/// (complete.h).
ExitCode run_program(const Program& program, const std::vector<std::string>& arguments,
                     Output& output);

}  // namespace swarmsmith
