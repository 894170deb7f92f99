#include "coordinator/campaign/campaign_file.h"

#include "coordinator/campaign/campaign_text.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// Campaigns in a folder that is not there, so that no file they name is read: refused with reasons
/// and places, or read to a campaign whose normalised text reads back to the same answer.
void run(std::string_view input) {
  const std::filesystem::path file = "/no-such-folder/of/campaigns/campaign.toml";
  const auto campaign = parse_campaign(input, file);
  if (!campaign) return require_reasons(campaign.error());
  const std::string text = normalised_text(*campaign);
  const auto again = parse_campaign(text, file);
  require(again.has_value(), "a normalised text can be read");
  require(normalised_text(*again) == text, "a normalised text reads back to itself");
  require(deciding(*again) == deciding(*campaign), "what decides the answer is kept");
}

}  // namespace swarmsmith::fuzz
