#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/configuration.h"
#include "irace_core/files/irace_setup.h"
#include "irace_core/files/settings.h"
#include "irace_core/scenario.h"

namespace swarmsmith::cli {

/// From one configuration to another one, each of a finished run, or of a configurations file.
struct AblationWay {
  std::string from;  ///< irace's ids, or names of files
  std::string to;
  Configuration source;
  Configuration target;
};

/// What --ablation-source and --ablation-target name; without them the run's first configuration
/// and its best one.
Expected<AblationWay> ablation_way(const IraceSettings& settings, const IraceSetup& setup,
                                   const std::filesystem::path& finished);

/// What an ablation's store has in its name: each way to ask is a campaign of its own.
std::string ablation_ending(const IraceSettings& settings, AblationType type);

/// The words of R's program `ablation` as those of irace: -S 1 is --ablation-source 1. An error
/// says what to write for those that are not there.
Expected<std::vector<std::string>> words_of_r_ablation(std::vector<std::string> words);

}  // namespace swarmsmith::cli
