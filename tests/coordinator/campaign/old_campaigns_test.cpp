#include <gmock/gmock.h>
#include <map>
#include <regex>

#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/campaign_text.h"
#include "storage/store.h"
#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/temporary_folder.h"

// Campaign files as earlier programs stored them, beside what those said of them:
// tests/golden/stores.

namespace swarmsmith {
namespace {

CampaignRow campaign_of_schema(int schema) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(
      SWARMSMITH_TEST_DATA "/stores/schema-" + std::to_string(schema) + ".sqlite",
      folder / "old.db");
  return (*StoreReader::open(folder / "old.db"))->campaign();
}

/// The entries of an object of texts.
std::map<std::string, std::string> entries_of(const std::string& json) {
  static const std::regex kEntry(R"re("((?:[^"\\]|\\.)*)":"((?:[^"\\]|\\.)*)")re");
  std::map<std::string, std::string> entries;
  for (std::sregex_iterator it(json.begin(), json.end(), kEntry), end; it != end; ++it)
    entries[(*it)[1]] = (*it)[2];
  return entries;
}

class OldCampaigns : public ::testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Schema, OldCampaigns, ::testing::Values(1, 2, 3, 4, 6));

TEST_P(OldCampaigns, DecideWhatTheyDecided) {
  const CampaignRow old = campaign_of_schema(GetParam());
  auto before = entries_of(old.deciding);
  auto now = entries_of(campaign_row(parsed(old.file)).deciding);
  before.erase("engine.version");
  now.erase("engine.version");
  EXPECT_GT(before.size(), 60U);
  for (const auto& [key, value] : before)
    EXPECT_EQ(now[key], value) << key;
  // The first schema is older than many options of races.
  if (GetParam() > 1) {
    EXPECT_EQ(now, before);
  }
}

TEST_P(OldCampaigns, HaveTheirOldDigestWhereEngineAndRacesAreTheSame) {
  const CampaignRow old = campaign_of_schema(GetParam());
  const bool is_same_program =
      entries_of(old.deciding)["engine.version"] ==
      entries_of(campaign_row(parsed(old.file)).deciding)["engine.version"];
  EXPECT_EQ(is_same_program, GetParam() >= 4) << "engine: the golden stores need a newer one";
  EXPECT_EQ(campaign_digest(parsed(old.file)) == old.digest, is_same_program);
}

}  // namespace
}  // namespace swarmsmith
