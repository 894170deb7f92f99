#include <memory>

#include "base/text/json.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"

namespace swarmsmith::cli {
namespace {

/// The store's digest. For several campaigns, one line each follows, with the digest of that
/// campaign alone.
void write(Output& output, StoreReader& store) {
  const std::string digest = store.digest();
  const std::vector<StoredCampaign> campaigns = store.campaigns();
  const bool several = campaigns.size() > 1;
  const auto own_digest = [&](const StoredCampaign& campaign) {
    return several ? store.alone(campaign.id)->digest() : digest;
  };
  if (!output.json) {
    output.out << digest << "\n";
    for (const StoredCampaign& campaign : campaigns)
      if (several) output.out << own_digest(campaign) << "  " << campaign.row.name << "\n";
    return;
  }
  JsonObject object;
  object.add("digest", digest);
  if (several) {
    object.add("campaigns", json_list(campaigns, [&](const StoredCampaign& campaign) {
                 return JsonObject()
                     .add("name", campaign.row.name)
                     .add("digest", own_digest(campaign))
                     .add("campaign", campaign.row.digest);
               }));
  } else {
    object.add("campaign", campaigns.front().row.digest);
  }
  output.out << object.text() << "\n";
}

}  // namespace

CommandRun declare_digest(Options& options) {
  auto argument = std::make_shared<StoreArgument>();
  argument->declare(options);
  return [argument](Output& output) {
    const auto store = argument->open();
    if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
    write(output, **store);
    return ExitCode::Done;
  };
}

}  // namespace swarmsmith::cli
