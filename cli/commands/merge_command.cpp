#include "base/plain_text.h"
#include "base/shown_text.h"
#include "base/text/json.h"
#include "storage/merge.h"

#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/commands/commands.h"
#include "cli/replay/design_worlds.h"
#include "console/counter.h"

namespace swarmsmith::cli {
namespace {

struct MergeArguments {
  std::vector<std::string> stores;
  std::string out;
};

/// "d4 to d9".
std::string designs_text(const StoredCampaign& campaign) {
  if (campaign.designs == 0) return "no designs";
  const std::string first = to_string(DesignId{campaign.designs_before + 1});
  if (campaign.designs == 1) return first;
  return first + " to " + to_string(DesignId{campaign.designs_before + campaign.designs});
}

void write(Output& output, const Merged& merged, const std::string& file) {
  if (!output.json) {
    for (const StoredCampaign& campaign : merged.campaigns)
      output.out << as_shown(campaign.row.name, Layout::Escaped) << "  " << campaign.state << "  "
                 << designs_text(campaign) << "\n";
    output.out << file << ": " << counted(merged.campaigns.size(), "campaign") << ", digest "
               << merged.digest << "\n";
    return;
  }
  const auto campaign_json = [](const StoredCampaign& campaign) {
    return JsonObject()
        .add("campaign", campaign.id)
        .add("name", campaign.row.name)
        .add("state", campaign.state)
        .add("designs_before", campaign.designs_before)
        .add("designs", campaign.designs);
  };
  output.out << JsonObject()
                    .add("store", file)
                    .add("digest", merged.digest)
                    .add("campaigns", json_list(merged.campaigns, campaign_json))
                    .text()
             << "\n";
}

ExitCode run_merge(const MergeArguments& arguments, Output& output) {
  if (arguments.out.empty()) {
    return fail(output, ExitCode::Usage,
                "no new file given; name it with -o: `swarmsmith merge a.db b.db -o all.db`");
  }
  Counter counter(output, "merged", "stores");
  const auto merged =
      merge_stores({arguments.stores.begin(), arguments.stores.end()}, arguments.out,
                   [&](std::int64_t done, std::int64_t of) { counter.tell(done, of); });
  if (!merged) {
    const bool about_out = merged.error().where == arguments.out;
    return fail(output, about_out ? ExitCode::Failed : ExitCode::Store, merged.error());
  }
  for (const std::string& warning : merged->warnings)
    print_note(output, "warning: " + warning);
  warn_of_mixed_names(arguments.out, output);
  // Reading it has left empty files of SQLite beside the new store.
  std::error_code ignored;
  for (const char* ending : {"-wal", "-shm"})
    std::filesystem::remove(arguments.out + ending, ignored);
  write(output, *merged, arguments.out);
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_merge(Options& options) {
  auto arguments = std::make_shared<MergeArguments>();
  options.words("STORE", arguments->stores,
                "The stores, in the order of their designs in the new one",
                Options::Need::Required);
  options.text("-o,--output STORE", arguments->out, "The new store's file");
  return [arguments](Output& output) { return run_merge(*arguments, output); };
}

}  // namespace swarmsmith::cli
