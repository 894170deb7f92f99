#include <filesystem>

#include "tests/cli/cli_support.h"
#include "tests/support/checks.h"
#include "tests/support/one_design.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTwoMissions =
    "format = 1\n[[mission]]\nname = \"aggregation\"\n[[mission]]\nname = \"grid_exploration\"\n"
    "[[method]]\nname = \"w\"\n[race]\nmax_experiments = 2000\n";

class ExportIrace : public WithStore {
 protected:
  std::string folder() const { return (folder_ / "irace").string(); }
};

TEST_F(ExportIrace, WritesAFolderFromAStore) {
  const Ran ran = run_well({"export", store_, "--format", "irace", "-o", folder()});
  EXPECT_EQ(ran.out, folder() + "\n");
  for (const char* name : {"README", "campaign.toml", "instances.txt", "parameters.txt",
                           "scenario.txt", "target-runner", "test-instances.txt"}) {
    EXPECT_TRUE(fs::exists(fs::path(folder()) / name)) << name;
  }
  const auto permissions = fs::status(fs::path(folder()) / "target-runner").permissions();
  EXPECT_NE(permissions & fs::perms::owner_exec, fs::perms::none);
  // The campaign in it is the store's.
  const Ran check = run({"check", folder() + "/campaign.toml", "--json"});
  EXPECT_THAT(check.out, HasSubstr(campaign_digest(one_design_campaign())));
}

TEST_F(ExportIrace, NeverOverwrites) {
  run_well({"export", store_, "--format", "irace", "-o", folder()});
  EXPECT_THAT(refusal({"export", store_, "--format", "irace", "-o", folder()}),
              HasSubstr("already exists"));
}

TEST_F(ExportIrace, WantsToKnowWhichDesignWhereTheyDiffer) {
  const std::string file = (folder_ / "two.toml").string();
  write_file(file, kTwoMissions);
  EXPECT_THAT(refusal({"export", file, "--format", "irace", "-o", folder()}),
              HasSubstr("d1 aggregation w repetition 1, d2 grid_exploration w"));
  EXPECT_FALSE(fs::exists(folder()));
  EXPECT_THAT(refusal({"export", file, "--format", "irace", "--design", "d3", "-o", folder()}),
              HasSubstr("no design d3"));
  EXPECT_EQ(run({"export", file, "--format", "irace", "--design", "d2", "-o", folder()}).code, 0);
}

TEST_F(ExportIrace, SaysWhatIsWrong) {
  EXPECT_THAT(run({"export", store_, "--format", "irace"}).err, HasSubstr("-o FOLDER"));
  const std::string file = (folder_ / "bad.toml").string();
  write_file(file, "format = 1\n");
  EXPECT_THAT(refusal({"export", file, "--format", "irace", "-o", folder()}),
              HasSubstr("bad.toml:"));
}

TEST_F(ExportIrace, EvaluateTakesItsWorldFromACampaign) {
  const std::string file = (folder_ / "two.toml").string();
  write_file(file, kTwoMissions);
  const Ran named = run({"evaluate", kExploreText, "--flavour", "watermelon", "--mission",
                         "grid_exploration", "--seeds", "7-9", "--json"});
  const Ran taken = run(
      {"evaluate", kExploreText, "--campaign", file, "--design", "d2", "--seeds", "7-9", "--json"});
  EXPECT_EQ(taken.code, 0) << taken.err;
  EXPECT_EQ(taken.out, named.out);
  EXPECT_THAT(refusal({"evaluate", kExploreText, "--campaign", file}),
              HasSubstr("no design given"));
}

}  // namespace
}  // namespace swarmsmith::cli
