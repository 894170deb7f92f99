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

/// What remains of a command once its words are read.
using CommandRun = std::function<ExitCode(Output&)>;

/// One command of a program.
struct ProgramCommand {
  std::string_view name;     ///< one word, or two: "calibrate camera"
  std::string_view summary;  ///< one line
  std::string_view details;  ///< examples and what else a person needs, below the options
  /// Declares the command's options and returns what runs when they were read.
  CommandRun (*declare)(Options& options) = nullptr;
  /// In place of `declare`, for a command that reads its words, help and flags itself.
  ExitCode (*run_words)(const std::vector<std::string>& words, Output& output) = nullptr;
  /// Changes the words before they are read.
  std::vector<std::string> (*prepare)(std::vector<std::string> words) = nullptr;
  /// Of a command with `run_words`: what it reads. Without it `run_words` becomes another program,
  /// which answers for itself.
  std::vector<DeclaredOption> (*options)() = nullptr;
};

/// A program that a person types.
struct Program {
  std::string_view name;     ///< "swarmsmith"
  std::string_view purpose;  ///< a sentence, the first line of its help
  std::span<const ProgramCommand> commands;
  std::string_view begin;  ///< last lines of its help: where a newcomer begins
  OfferValues values = nullptr;
};

/// Runs the program with the words after its name. Output goes to `output`, whose flags (`--json`,
/// `--quiet`, `-v`, `--no-color`) are read first. Wrong usage is explained on the error stream.
/// Two first words are for scripts, and in no help: `--declared` prints the commands and all that
/// they read as JSON, `--complete WORD...` what the last word may become (complete.h).
ExitCode run_program(const Program& program, const std::vector<std::string>& arguments,
                     Output& output);

}  // namespace swarmsmith
