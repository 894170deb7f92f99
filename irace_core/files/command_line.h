#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/settings.h"

namespace swarmsmith {

/// The action that a command line requests. If it requests several, Help comes before Version,
/// Version before Init, and Init before OnlyTest, PsRace, Ablation and Check.
enum class IraceAction { Run, Check, Init, OnlyTest, PsRace, Ablation, Help, Version };

/// The arguments after `swarmsmith irace`, each checked by itself (irace facts, 21).
struct IraceCommandLine {
  IraceAction action = IraceAction::Run;
  std::filesystem::path only_test;  ///< absolute; only for OnlyTest
  IraceSettings settings;           ///< also the settings of our own options, by their switches
  std::vector<std::string> warnings;
};
using IraceCommandLineOrErrors = tl::expected<IraceCommandLine, std::vector<Error>>;

/// Reads `--opt value`, `--opt=value` (the value may be empty), short switches and flags; a flag
/// takes no value, except one attached to it or a 0 or 1 that follows. The last of equal options
/// wins. Relative paths start from `folder`, which is absolute. `where` of an error is the switch.
IraceCommandLineOrErrors read_irace_command_line(std::span<const std::string> words,
                                                 const std::filesystem::path& folder);

}  // namespace swarmsmith
