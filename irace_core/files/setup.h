#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/command_line.h"
#include "irace_core/files/irace_setup.h"

namespace swarmsmith {

using IraceSetupOrErrors = tl::expected<IraceSetup, std::vector<Error>>;

/// Where paths and programs are looked for.
struct SetupSurroundings {
  std::filesystem::path folder;  ///< the current one, absolute
  std::string search_path;       ///< PATH: folders with colons between them
};
/// Those of this process.
SetupSurroundings surroundings_of_process();

/// Reads the scenario file that a command line names (or ./scenario.txt, if there is one), and all
/// files that either names, and checks them: an option of the command line wins over one of the
/// file, and that over irace's default (irace facts, 21 and 22). What is wrong is reported together
/// as far as possible; `where` is file:line:column, a switch, an option's name or a file.
///
/// OnlyTest needs test instances, but neither a budget nor training instances. The command line's
/// own warnings are not repeated in the setup's.
IraceSetupOrErrors read_irace_setup(const IraceCommandLine& line,
                                    const SetupSurroundings& surroundings);

}  // namespace swarmsmith
