#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.h"
#include "irace_core/files/command_line.h"
#include "irace_core/files/irace_setup.h"

namespace swarmsmith {

using IraceSetupOrErrors = tl::expected<IraceSetup, std::vector<Error>>;

/// Folders in which paths and programs are searched for.
struct SetupSurroundings {
  std::filesystem::path folder;  ///< the current folder, absolute
  std::string search_path;       ///< PATH: folders separated by colons
};
/// The folders of this process.
SetupSurroundings surroundings_of_process();

/// Reads the scenario file that a command line names (or ./scenario.txt, if it exists), and all
/// files that either names, and checks them. An option on the command line takes precedence over
/// one in the file, and that over irace's default (irace facts, 21 and 22). As far as possible, all
/// errors are reported together; `where` is file:line:column, a switch, the name of an option or a
/// file.
///
/// OnlyTest needs test instances, but neither a budget nor training instances. The warnings of the
/// command line are not repeated in the setup's warnings.
IraceSetupOrErrors read_irace_setup(const IraceCommandLine& line,
                                    const SetupSurroundings& surroundings);

}  // namespace swarmsmith
