#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Which irace reads the files; they differ in where the digits stand, and in some options (irace
/// facts, 26).
enum class IraceVersion { V3_5, V4 };

/// A file of a folder that is to be written.
struct NamedText {
  std::string name;
  std::string text;
  bool is_program = false;
};

/// A folder in which R's irace tunes what the design tunes, against this simulator: scenario,
/// parameters (switches and values are the text grammar's), instances, and a target-runner that
/// calls `program evaluate`. `program` is absolute. Fails for what irace, or that version of it,
/// cannot express: the sentence names the option.
Expected<std::vector<NamedText>> irace_folder(const Campaign& campaign, const DesignRow& design,
                                              IraceVersion version,
                                              const std::filesystem::path& program);

}  // namespace swarmsmith
