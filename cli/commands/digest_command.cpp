#include <memory>

#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"

namespace swarmsmith::cli {
namespace {

/// The store's digest; of several campaigns a line each follows, with what they have alone.
void write(Output& output, StoreReader& store) {
  const std::string digest = store.digest();
  const std::vector<StoredCampaign> campaigns = store.campaigns();
  const bool several = campaigns.size() > 1;
  std::string lines;
  std::string objects;
  for (const StoredCampaign& campaign : campaigns) {
    const std::string own = several ? store.alone(campaign.id)->digest() : digest;
    lines += own + "  " + campaign.row.name + "\n";
    objects += (objects.empty() ? "{" : ",{") + ("\"name\":" + json_text(campaign.row.name)) +
               ",\"digest\":" + json_text(own) + ",\"campaign\":" + json_text(campaign.row.digest) +
               "}";
  }
  if (!output.json) {
    output.out << digest << "\n" << (several ? lines : "");
  } else if (several) {
    output.out << "{\"digest\":" << json_text(digest) << ",\"campaigns\":[" << objects << "]}\n";
  } else {
    output.out << "{\"digest\":" << json_text(digest)
               << ",\"campaign\":" << json_text(campaigns.front().row.digest) << "}\n";
  }
}

}  // namespace

Run declare_digest(Options& options) {
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
