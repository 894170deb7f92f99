#include "cli/arguments/campaign_argument.h"

#include "coordinator/campaign/campaign_file.h"

namespace swarmsmith::cli {

std::optional<Campaign> read_or_complain(const std::string& file, Output& output,
                                         std::optional<std::int64_t> budget) {
  auto campaign = read_campaign(file, budget);
  if (campaign) return std::move(*campaign);
  for (const Error& error : campaign.error())
    print_error(output, error);
  return std::nullopt;
}

}  // namespace swarmsmith::cli
