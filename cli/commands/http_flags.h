#pragma once

#include <string>

#include "cli/run/campaign_run.h"
#include "console/options.h"

namespace swarmsmith::cli {

/// Where a coordinator shows what it does.
struct HttpFlags {
  std::string http;
  std::string token_file;

  /// Declares --http and --http-token-file.
  void declare(Options& options, const std::string& otherwise);
  /// `otherwise` is the default address of the pages; empty for no pages.
  void put(RunOptions& run, const std::string& otherwise) const;
};

}  // namespace swarmsmith::cli
