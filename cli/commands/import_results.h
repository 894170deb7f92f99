#pragma once

#include <string>
#include <vector>

#include "console/exit_code.h"
#include "console/output.h"

namespace swarmsmith::cli {

/// Arguments of `import` for adding to a store.
struct ImportArguments {
  std::string file;
  std::string into;  ///< the store
  std::string flavour;
  std::vector<std::string> missions;
  std::string method;
  std::string name;    ///< name of the campaign made from machines or a log
  std::string source;  ///< source of scores in a file that does not name one
  std::vector<std::string> costs_of;
  bool replace = false;
};

/// Imports scores (.csv), machines (.csv, .txt) or a log of irace (.Rdata, or the folder of its
/// tables) into a store, all or nothing.
ExitCode import_into_store(const ImportArguments& arguments, Output& output);

}  // namespace swarmsmith::cli
