#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/settings.h"

namespace swarmsmith {

/// What a command line asks for. Help comes before Version, that before Init, OnlyTest, PsRace,
/// Ablation and Check.
enum class IraceAction { Run, Check, Init, OnlyTest, PsRace, Ablation, Help, Version };

/// The words after `swarmsmith irace`, checked one by one (irace facts, 21).
struct IraceCommandLine {
  IraceAction action = IraceAction::Run;
  std::filesystem::path only_test;  ///< absolute; of OnlyTest
  IraceSettings settings;           ///< those of our own options, too, by their switches
  std::vector<std::string> warnings;
};
using IraceCommandLineOrErrors = tl::expected<IraceCommandLine, std::vector<Error>>;

/// Reads `--opt value`, `--opt=value` (which may be empty), short switches and flags, which take no
/// value unless it is attached or a 0 or 1 follows. The last of equal options wins. Relative paths
/// will be from `folder`, which is absolute. `where` of an error is the switch.
IraceCommandLineOrErrors read_irace_command_line(std::span<const std::string> words,
                                                 const std::filesystem::path& folder);

}  // namespace swarmsmith
