#pragma once

#include <memory>
#include <string>

#include "base/expected.h"
#include "console/options.h"
#include "storage/store.h"
#include "storage/store_at_rest.h"

namespace swarmsmith::cli {

/// The store that a command reads: the argument STORE, else `--store`, else SWARMSMITH_STORE.
struct StoreArgument {
  std::string word;
  std::string option;

  /// Declares the argument and the option, or only the option without `with_word`.
  void declare(Options& options, bool with_word = true);
  /// The path of the store, or an error that says how to name a store.
  Expected<std::string> path() const;
  /// Opens the store. Every error means exit code 3, except an error of `path`.
  Expected<std::unique_ptr<StoreReader>> open() const;
  /// Like `open`, for numbers that are published: refuses a store whose rows do not come from one
  /// commit (storage/whole.h).
  Expected<std::unique_ptr<StoreReader>> open_whole() const;
};

/// Opens a store to add data to it. Facts that an old schema lacks are read from the file of its
/// first campaign.
Expected<std::unique_ptr<StoreAtRest>> open_at_rest(const std::string& path,
                                                    StoreAtRest::IfMissing if_missing);

/// The exit code after an error of `open`.
ExitCode exit_code_of_store(const Error& error);

}  // namespace swarmsmith::cli
