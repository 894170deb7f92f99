#pragma once

#include <memory>
#include <string>

#include "base/expected.h"
#include "console/options.h"
#include "storage/store.h"
#include "storage/store_at_rest.h"

namespace swarmsmith::cli {

/// The store that a command reads: the word STORE, else `--store`, else SWARMSMITH_STORE.
struct StoreArgument {
  std::string word;
  std::string option;

  /// Declares both. Without `with_word` only the option.
  void declare(Options& options, bool with_word = true);
  /// Where the store is, or a sentence that says how to name it.
  Expected<std::string> path() const;
  /// Opens it; every error means exit code 3, except one of `path`.
  Expected<std::unique_ptr<StoreReader>> open() const;
  /// The same, for numbers that leave the store: refuses one whose rows are not those of one commit
  /// (storage/whole.h).
  Expected<std::unique_ptr<StoreReader>> open_whole() const;
};

/// Opens a store, whose first campaign's file tells what an old schema does not, to add to it.
Expected<std::unique_ptr<StoreAtRest>> open_at_rest(const std::string& path,
                                                    StoreAtRest::IfMissing if_missing);

/// What to exit with after an error of `open`.
ExitCode exit_code_of_store(const Error& error);

}  // namespace swarmsmith::cli
