#pragma once

#include <string>
#include <utility>
#include <vector>

#include "irace_core/files/irace_setup.h"

namespace swarmsmith {

/// The versions of irace that differ in what they read (irace facts, 26).
enum class IraceVersion { V3_5, V4 };

/// The files that a printed scenario names, relative to its folder; empty ones are not named.
struct IraceFileNames {
  std::string parameters = "parameters.txt";
  std::string training = "instances-list.txt";
  std::string training_folder{};  ///< in place of the file
  std::string test;
  std::string configurations;
  std::string forbidden;  ///< only irace 3.5 has it in a file of its own
};

struct IraceScenarioText {
  std::string text;
  std::vector<std::string> remarks;  ///< what this version of irace cannot be told, a sentence each
};

/// A scenario file for R's irace with all options of `setup` that differ from that version's
/// defaults, and the files' names. Paths are written as they are in the setup, absolute or not. For
/// 3.5 `digits` is that of the setup's space. Read here, a text for 4 gives the same options again,
/// but for what the remarks say.
IraceScenarioText print_irace_scenario(const IraceSetup& setup, IraceVersion version,
                                       const IraceFileNames& names = {});

/// Every option that the setup has a value for, by its name in scenario files, with the value in
/// R's words: TRUE, 5, "text". Nothing stands for an option that is off by being absent (boundMax).
std::vector<std::pair<std::string, std::string>> irace_options(const IraceSetup& setup);

}  // namespace swarmsmith
