#include <vector>

#include "base/text/table_reader.h"
#include "coordinator/campaign/campaign_text.h"
#include "sim/files/color_text.h"
#include "tests/coordinator/campaign/campaign_support.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"
#include "tests/support/score_rules.h"
#include "tests/support/temporary_folder.h"

// What campaign files, their normalised text and their documentation say of scores, for every kind
// in the list.

namespace swarmsmith {
namespace {

ScoreRule read(const std::string& score) {
  return parsed(FileText{.mission = "name = \"x\"\nscore = { " + score + " }\n"}.text())
      .missions[0]
      .mission.rule;
}

TEST(ScoreText, OfEveryKindReadsBackToIt) {
  Campaign campaign = parsed(FileText{}.text());
  for (const ScoreRule& rule : not_empty(rules_of_every_kind())) {
    campaign.missions[0].mission.rule = rule;
    const std::string text = normalised_text(campaign);
    campaign.missions[0].mission.rule = parsed(text).missions[0].mission.rule;
    EXPECT_EQ(normalised_text(campaign), text);
    EXPECT_EQ(kind_of(campaign.missions[0].mission.rule), kind_of(rule));
  }
}

TEST(ScoreText, HasEveryParameter) {
  Campaign campaign = parsed(FileText{}.text());
  campaign.missions[0].mission.rule =
      ColorReward{.rewards = {{{255, 0, 0}, -1.5}, {{1, 2, 3}, 2}}, .at = When::Sum};
  EXPECT_THAT(normalised_text(campaign),
              HasSubstr("[mission.score]\nkind = \"color_reward\"\n"
                        "rewards = { red = -1.5, \"#010203\" = 2 }\nat = \"sum\"\n"));
}

TEST(ScoreKeys, OfEachKindAreRead) {
  EXPECT_EQ(read("kind = \"robots_on\", color = \"#010203\", at = \"sum\", maximize = true"),
            ScoreRule(RobotsOn{.color = {1, 2, 3}, .at = When::Sum}));
  EXPECT_EQ(read("kind = \"coverage\", tiles = 5, side = 2"),
            ScoreRule(Coverage{.tiles = 5, .side_m = 2}));
  EXPECT_EQ(read("kind = \"coverage\""), ScoreRule(Coverage{}));
  EXPECT_EQ(read("kind = \"color_reward\", at = \"sum\", rewards = { red = -0.5 }"),
            ScoreRule(ColorReward{.rewards = {{{255, 0, 0}, -0.5}}, .at = When::Sum}));
  EXPECT_EQ(read("kind = \"foraging\", source = \"red\""),
            ScoreRule(Foraging{.source = {255, 0, 0}}));
  EXPECT_EQ(read("kind = \"formula\", value = \"min(red, blue)\", of = \"swarm\", at = \"sum\""),
            ScoreRule(Formula{.value = "min(red, blue)", .of = "swarm", .at = When::Sum}));
  EXPECT_EQ(read("kind = \"objects_on\", color = \"white\""),
            ScoreRule(ObjectsOn{.color = {255, 255, 255}, .at = When::End}));
}

/// Collects rows: type and default of each parameter as the table in docs/campaign-file.md has
/// them.
struct Documented {
  std::string kind;
  std::vector<std::string> rows{};

  void operator()(const ScoreField& field, double value) {
    add(field, "number, " + limits(field), number_text(value));
  }
  void operator()(const ScoreField& field, int value) {
    add(field, "integer, " + limits(field), std::to_string(value));
  }
  void operator()(const ScoreField& field, bool value) {
    add(field, "true or false", value ? "true" : "false");
  }
  void operator()(const ScoreField& field, Rgb value) {
    add(field, "colour", "`\"" + color_text(value) + "\"`");
  }
  void operator()(const ScoreField& field, When value) {
    add(field, "`\"end\"`, `\"sum\"`", "`\"" + std::string(name_of(value)) + "\"`");
  }
  void operator()(const ScoreField& field, const std::string& value) {
    std::string choices;
    for (const std::string_view choice : field.choices)
      choices += (choices.empty() ? "`\"" : ", `\"") + std::string(choice) + "\"`";
    add(field, choices.empty() ? "text" : choices, "`\"" + value + "\"`");
  }
  void operator()(const ScoreField& field, const std::vector<Reward>& /*value*/) {
    add(field, "table such as `{ red = 1, yellow = -2 }`", "");
  }

  static std::string limits(const ScoreField& field) {
    return number_text(field.least) + " to " + number_text(field.most);
  }
  void add(const ScoreField& field, const std::string& type, const std::string& fallback) {
    rows.push_back("| `\"" + kind + "\"` | `" + std::string(field.key) + "` | " + type + " |" +
                   (field.required ? "" : " " + fallback) + " | " + std::string(field.meaning) +
                   " |\n");
  }
};

TEST(ScoreDocs, HaveARowForEachKindAndEachKey) {
  const std::string page = whole_file(SWARMSMITH_SOURCE_DIR "/docs/campaign-file.md");
  for (const std::string& kind : not_empty(score_kinds())) {
    EXPECT_THAT(page, HasSubstr("\n| `\"" + kind + "\"` | ")) << "in the table of kinds";
    Documented documented{.kind = kind};
    const ScoreRule rule = *score_of_kind(kind);
    visit_fields(rule, documented);
    for (const std::string& row : documented.rows)
      EXPECT_NE(page.find("\n" + row), std::string::npos) << "docs lack the row\n" << row;
  }
}

}  // namespace
}  // namespace swarmsmith
