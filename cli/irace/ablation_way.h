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

/// The two configurations of an ablation, each from a finished run or from a configurations file.
struct AblationWay {
  std::string from;  ///< irace's ids, or names of files
  std::string to;
  Configuration source;
  Configuration target;
};

/// The configurations named by --ablation-source and --ablation-target; by default the first one of
/// the run and its best one.
Expected<AblationWay> ablation_way(const IraceSettings& settings, const IraceSetup& setup,
                                   const std::filesystem::path& finished);

/// The suffix of the name of the ablation's store: ablations with other options are other
/// campaigns.
std::string ablation_ending(const IraceSettings& settings, AblationType type);

/// Translates the options of R's program `ablation` to options of irace: -S 1 becomes
/// --ablation-source 1. For options that do not exist, the error says what to use instead.
Expected<std::vector<std::string>> words_of_r_ablation(std::vector<std::string> words);

}  // namespace swarmsmith::cli
