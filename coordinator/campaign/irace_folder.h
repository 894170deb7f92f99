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

/// A file to write into a folder.
struct NamedText {
  std::string name;
  std::string text;
  bool is_program = false;
};

struct IraceFolder {
  std::vector<NamedText> files;
  std::vector<std::string> remarks;  ///< a sentence for each unsupported setting
};

/// The irace setup of a design: options, instances and parameter space. For machines and trees the
/// space uses the words of their text grammar; for networks it consists of the weights. Fails for
/// settings that irace cannot express.
Expected<IraceSetup> irace_setup(const Campaign& campaign, const DesignRow& design);

/// The files of a folder in which R's irace can do the search of this design: scenario, parameters,
/// instances. For control software, irace evaluates with this simulator: switches and values form
/// the text of the control software, and the folder's target-runner calls `program evaluate`
/// (`program` is an absolute path). For a design with a target, irace calls the target's programs.
/// Fails for settings that irace cannot express.
Expected<IraceFolder> irace_folder(const Campaign& campaign, const DesignRow& design,
                                   IraceVersion version, const std::filesystem::path& program);

}  // namespace swarmsmith
