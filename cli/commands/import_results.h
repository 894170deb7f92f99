#pragma once

#include <string>
#include <vector>

#include "console/exit_code.h"
#include "console/output.h"

namespace swarmsmith::cli {

/// What `import` takes into a store.
struct ImportArguments {
  std::string file;
  std::string into;  ///< the store
  std::string flavour;
  std::vector<std::string> missions;
  std::string method;
  std::string name;    ///< of the campaign that machines or a log become
  std::string source;  ///< of scores that do not say it
  std::vector<std::string> costs_of;
  bool replace = false;
};

/// Scores (.csv), machines (.csv, .txt) or a log of irace (.Rdata, or the folder of its tables)
/// into a store, all or nothing.
ExitCode import_into_store(const ImportArguments& arguments, Output& output);

}  // namespace swarmsmith::cli
