#include <gmock/gmock.h>

#include "tests/coordinator/cli/cli_support.h"

namespace swarmsmith::cli {
namespace {

Campaign example(const std::string& name) {
  const auto file = std::filesystem::path(SWARMSMITH_SOURCE_DIR) / "examples" / (name + ".toml");
  auto campaign = read_campaign(file);
  if (campaign) return *campaign;
  for (const Error& error : campaign.error()) ADD_FAILURE() << to_string(error);
  return {};
}

TEST(Examples, OfEachMissionRunAsTheyAre) {
  for (const std::string name : {"aggregation", "grid_exploration", "color_selection"}) {
    const Campaign campaign = example(name);
    ASSERT_EQ(campaign.missions.size(), 1U);
    EXPECT_EQ(campaign.missions[0].mission, *built_in_mission(name));
  }
}

TEST(Examples, OfTheThesisAreThirtyDesignsOfAHundredThousandExperiments) {
  const Campaign campaign = example("thesis");
  EXPECT_EQ(design_rows(campaign).size(), 30U);
  EXPECT_EQ(campaign.race.max_experiments, 100'000);
}

TEST(Examples, OfAMissionOfOnesOwnUseEveryKindOfScore) {
  const Campaign campaign = example("own_missions");
  EXPECT_EQ(campaign.missions.size(), 3U);
}

}  // namespace
}  // namespace swarmsmith::cli
