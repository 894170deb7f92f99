#include "cli/arguments/store_argument.h"

#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "storage/whole.h"

namespace swarmsmith::cli {

void StoreArgument::declare(Options& options, bool with_word) {
  if (with_word) options.text("STORE", word, "The campaign's store (else SWARMSMITH_STORE)");
  options.text("--store STORE", option, "The campaign's store (else SWARMSMITH_STORE)");
}

Expected<std::string> StoreArgument::path() const {
  if (!word.empty()) return word;
  if (!option.empty()) return option;
  if (std::string store = store_of_environment(); !store.empty()) return store;
  return bad_input(
      "no store given; name its file, for instance `--store demo.db`, or set SWARMSMITH_STORE");
}

Expected<std::unique_ptr<StoreReader>> StoreArgument::open() const {
  const auto where = path();
  if (!where) return Unexpected(where.error());
  return StoreReader::open(*where);
}

Expected<std::unique_ptr<StoreReader>> StoreArgument::open_whole() const {
  auto store = open();
  if (!store) return store;
  if (auto whole = check_rows(*path()); !whole) return Unexpected(whole.error());
  return store;
}

Expected<std::unique_ptr<StoreAtRest>> open_at_rest(const std::string& path,
                                                    StoreAtRest::IfMissing if_missing) {
  std::vector<DesignRow> designs;
  if (const auto reader = StoreReader::open(path)) {
    const auto campaign = parse_campaign((*reader)->campaign().file, path);
    if (campaign) designs = design_rows(*campaign);
  }
  return StoreAtRest::open(path, if_missing, designs);
}

ExitCode exit_code_of_store(const Error& error) {
  // The error has no place only if no store was named.
  return error.where.empty() ? ExitCode::Usage : ExitCode::Store;
}

}  // namespace swarmsmith::cli
