#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "irace_core/files/irace_setup.h"
#include "irace_core/files/scenario_text.h"
#include "storage/rows.h"

namespace swarmsmith {

/// A file of a folder that is to be written.
struct NamedText {
  std::string name;
  std::string text;
  bool is_program = false;
};

struct IraceFolder {
  std::vector<NamedText> files;
  std::vector<std::string> remarks;  ///< what that irace cannot be told, a sentence each
};

/// What irace gets of a design: options, instances, and the space, which of machines and trees
/// is in the words of their text grammar, and of networks the weights. Fails for what irace cannot
/// express.
Expected<IraceSetup> irace_setup(const Campaign& campaign, const DesignRow& design);

/// A folder in which R's irace tunes what the design tunes: scenario, parameters, instances. A
/// design of control software is tuned against this simulator: switches and values are its text,
/// and the folder's target-runner calls `program evaluate` (`program` is absolute). A design with a
/// target calls the target's programs. Fails for what irace cannot express.
Expected<IraceFolder> irace_folder(const Campaign& campaign, const DesignRow& design,
                                   IraceVersion version, const std::filesystem::path& program);

}  // namespace swarmsmith
