#pragma once

#include <string>
#include <utility>
#include <vector>

#include "irace_core/files/irace_setup.h"

namespace swarmsmith {

/// The versions of irace whose input files differ (irace facts, 26).
enum class IraceVersion { V3_5, V4 };

/// The file names in a printed scenario, relative to its folder; empty names are not printed.
struct IraceFileNames {
  std::string parameters = "parameters.txt";
  std::string training = "instances-list.txt";
  std::string training_folder{};  ///< instead of the file
  std::string test;
  std::string configurations;
  std::string forbidden;  ///< only irace 3.5 has them in a separate file
};

struct IraceScenarioText {
  std::string text;
  /// Settings that this version of irace does not support, one sentence each.
  std::vector<std::string> remarks;
};

/// A scenario file for R's irace with all options of `setup` that differ from that version's
/// defaults, and the names of the files. Paths are written unchanged, absolute or not. For 3.5,
/// `digits` is taken from the setup's space. From a text for 4, this program reads the same options
/// back, except for those named in the remarks.
IraceScenarioText print_irace_scenario(const IraceSetup& setup, IraceVersion version,
                                       const IraceFileNames& names = {});

/// Every option for which the setup has a value, by its name in scenario files, with the value in
/// R's notation: TRUE, 5, "text". The value is empty for an option that is off when it is absent
/// (boundMax).
std::vector<std::pair<std::string, std::string>> irace_options(const IraceSetup& setup);

}  // namespace swarmsmith
