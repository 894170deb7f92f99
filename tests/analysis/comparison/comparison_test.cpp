#include "analysis/comparison/comparison.h"

#include "analysis/comparison/paper_text.h"
#include "tests/analysis/comparison/scores.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// Six designs of two missions, each in simulation and reality; real ones are worse.
std::vector<DesignScore> in_two_sources() {
  std::vector<Scored> designs;
  for (int i = 1; i <= 6; ++i) {
    designs.push_back({.design = i, .repetition = i, .source = "real", .scores = {1.0 * i}});
    designs.push_back(
        {.design = i, .repetition = i, .source = "rvr", .scores = {1.25 * i + 1, 1.25 * i + 2}});
    designs.push_back({.design = i + 10,
                       .mission = "grid",
                       .repetition = i,
                       .source = "rvr",
                       .scores = {-1000.0 * i}});
  }
  return records_of(designs);
}

/// Five designs of each of two methods in one source.
std::vector<Scored> of_two_methods() {
  std::vector<Scored> designs;
  for (int i = 1; i <= 5; ++i) {
    designs.push_back({.design = i, .method = "better", .repetition = i, .scores = {10.0 + i}});
    designs.push_back({.design = i + 5, .method = "worse", .repetition = i, .scores = {1.0 * i}});
  }
  return designs;
}

TEST(Comparison, PairsTheSameDesignsBySource) {
  const Comparison comparison = compare(in_two_sources(), {.by = CompareBy::Source});
  ASSERT_EQ(comparison.pairs.size(), 1U);  // nothing of the grid is real
  const ComparedPair& pair = comparison.pairs.front();
  EXPECT_EQ(pair.mission, "aggregation");
  EXPECT_EQ(pair.first, "rvr");
  EXPECT_EQ(pair.second, "real");
  EXPECT_TRUE(pair.paired);
  EXPECT_EQ(pair.n_first, 6U);
  EXPECT_EQ(pair.test.statistic, 21);
  EXPECT_DOUBLE_EQ(*pair.test.p_value, 2.0 / 64);
  EXPECT_DOUBLE_EQ(pair.difference.value, 1.5 + 0.25 * 3.5);
  EXPECT_THAT(pair.notes, ElementsAre(HasSubstr("n is small")));
  EXPECT_THAT(comparison.notes, Not(Contains(HasSubstr(" in common"))))
      << "designs of different missions are not paired";
}

TEST(Comparison, AValueIsADesignsMeanOrARun) {
  const Comparison by_design = compare(in_two_sources(), {.by = CompareBy::Mission});
  ASSERT_EQ(by_design.groups.size(), 3U);
  EXPECT_EQ(by_design.groups[0].source, "rvr");
  EXPECT_EQ(by_design.groups[0].runs, 12U);
  EXPECT_EQ(by_design.groups[0].summary.n, 6U);
  EXPECT_EQ(by_design.groups[0].values.front(), 2.75);
  const Comparison by_run =
      compare(in_two_sources(),
              {.by = CompareBy::Mission, .choice = {.purpose = "", .unit = ScoreUnit::Run}});
  EXPECT_EQ(by_run.groups[0].summary.n, 12U);
  EXPECT_EQ(by_run.groups[0].values.front(), 2.25);
}

TEST(Comparison, RunsArePairedBySeed) {
  const Comparison comparison =
      compare(in_two_sources(),
              {.by = CompareBy::Source, .choice = {.purpose = "", .unit = ScoreUnit::Run}});
  ASSERT_EQ(comparison.pairs.size(), 1U);
  EXPECT_EQ(comparison.pairs.front().n_first, 6U);
  EXPECT_THAT(comparison.pairs.front().notes,
              Contains("runs left out, since only one of the two sources has them: 6"));
  EXPECT_THAT(comparison.notes, Contains(HasSubstr("not independent")));
  EXPECT_THAT(compare(records_of(of_two_methods()),
                      {.by = CompareBy::Method, .choice = {.purpose = "", .unit = ScoreUnit::Run}})
                  .notes,
              Not(Contains(HasSubstr("not independent"))))
      << "a run of each design";
}

/// Six designs under two profiles, the second on seeds of its own from `first_seed` on.
std::vector<DesignScore> under_two_profiles(std::int64_t first_seed) {
  std::vector<Scored> designs;
  for (int i = 1; i <= 6; ++i) {
    designs.push_back({.design = i, .repetition = i, .scores = {1.0 * i, 2.0 * i}});
    designs.push_back({.design = i,
                       .repetition = i,
                       .source = "pseudo-reality",
                       .scores = {0.5 * i, 1.5 * i},
                       .purpose = "score",
                       .first_seed = first_seed});
  }
  return records_of(designs);
}

TEST(Comparison, SaysThatPairedDesignsRanOnOtherSeeds) {
  const std::string note =
      "the seeds of pseudo-reality and rvr differ in 6 of 6 designs, so part of the difference may "
      "come from the seeds";
  const Comparison other = compare(under_two_profiles(2), {.by = CompareBy::Source});
  EXPECT_THAT(other.pairs.front().notes, Contains(note));
  EXPECT_THAT(other.seeds, ElementsAre(note));
  EXPECT_THAT(paper_sentences(other).front().text, HasSubstr(note));
  const Comparison same = compare(under_two_profiles(1), {.by = CompareBy::Source});
  EXPECT_THAT(same.pairs.front().notes, Not(Contains(HasSubstr("seeds"))));
  EXPECT_THAT(same.seeds, IsEmpty());
}

TEST(Comparison, DesignsInOneSourceAloneAreLeftOutAndCounted) {
  auto scores = in_two_sources();
  std::erase_if(scores, [](const DesignScore& score) {
    return score.design == DesignId{3} && score.source == "real";
  });
  const ComparedPair pair = compare(scores, {.by = CompareBy::Source}).pairs.front();
  EXPECT_EQ(pair.n_first, 5U);
  EXPECT_THAT(pair.notes,
              Contains("designs left out, since only one of the two sources has them: 1"));
  EXPECT_THAT(pair.notes, Contains(HasSubstr("n is too small")));
}

TEST(Comparison, SourcesWithoutACommonDesignAreNotCompared) {
  const Comparison comparison =
      compare(records_of({{.design = 1, .source = "rvr", .scores = {1}},
                          {.design = 2, .repetition = 2, .source = "real", .scores = {2}}}),
              {.by = CompareBy::Source});
  EXPECT_THAT(comparison.pairs, IsEmpty());
  EXPECT_THAT(comparison.notes, Contains(HasSubstr(" in common")));
}

TEST(Comparison, MethodsMeetWithinAMissionAndSourceAlone) {
  auto designs = of_two_methods();
  designs.push_back({.design = 20, .method = "worse", .source = "real", .scores = {3}});
  designs.push_back({.design = 21, .mission = "grid", .method = "better", .scores = {-3}});
  const Comparison comparison = compare(records_of(designs), {.by = CompareBy::Method});
  ASSERT_EQ(comparison.pairs.size(), 1U);
  const ComparedPair& pair = comparison.pairs.front();
  EXPECT_EQ(pair.source, "rvr");
  EXPECT_EQ(pair.first, "better");
  EXPECT_FALSE(pair.paired);
  EXPECT_EQ(pair.test.statistic, 25);
  EXPECT_DOUBLE_EQ(*pair.test.p_value, 2.0 / 252);
  EXPECT_EQ(pair.a12, 1);
}

TEST(Comparison, MissionsAreSummarisedAndNeverCompared) {
  const Comparison comparison = compare(in_two_sources(), {.by = CompareBy::Mission});
  EXPECT_THAT(comparison.pairs, IsEmpty());
  EXPECT_THAT(comparison.ranks, IsEmpty());
  EXPECT_THAT(comparison.notes, Contains(HasSubstr("different units")));
}

TEST(Comparison, HolmsCorrectionIsOverAllPairs) {
  auto designs = of_two_methods();
  for (Scored design : of_two_methods()) {
    design.design += 100;
    design.mission = "grid";
    designs.push_back(design);
  }
  const Comparison comparison = compare(records_of(designs), {.by = CompareBy::Method});
  ASSERT_EQ(comparison.pairs.size(), 2U);
  for (const ComparedPair& pair : comparison.pairs)
    EXPECT_DOUBLE_EQ(*pair.p_holm, 4.0 / 252);
}

TEST(Comparison, MethodsAreRankedOverMissions) {
  auto designs = of_two_methods();
  designs.push_back({.design = 20, .mission = "grid", .method = "better", .scores = {-9}});
  designs.push_back({.design = 21, .mission = "grid", .method = "worse", .scores = {-3}});
  designs.push_back(
      {.design = 22, .mission = "grid", .method = "worse", .repetition = 2, .scores = {-3}});
  const Comparison comparison = compare(records_of(designs), {.by = CompareBy::Method});
  ASSERT_EQ(comparison.ranks.size(), 1U);
  const ComparedRanks& ranks = comparison.ranks.front();
  EXPECT_THAT(ranks.names, ElementsAre("better", "worse"));
  EXPECT_THAT(ranks.missions, ElementsAre("aggregation", "grid"));
  EXPECT_EQ(ranks.test.blocks, 2U);
  EXPECT_EQ(ranks.incomplete, 0U);
  EXPECT_DOUBLE_EQ(ranks.test.mean_ranks[0], 1.5);
}

TEST(Comparison, MergedCampaignsMayHaveARepetitionTwice) {
  auto designs = of_two_methods();
  for (Scored design : of_two_methods()) {
    design.design += 100;
    designs.push_back(design);
  }
  const Comparison comparison = compare(records_of(designs), {.by = CompareBy::Method});
  EXPECT_EQ(comparison.pairs.front().n_first, 10U);
  EXPECT_THAT(comparison.ranks, IsEmpty());
  EXPECT_THAT(comparison.notes,
              Contains(HasSubstr("rvr: no ranks, since fewer than two missions")));
}

TEST(Comparison, SourcesAreRankedOverDesigns) {
  const Comparison comparison = compare(in_two_sources(), {.by = CompareBy::Source});
  ASSERT_EQ(comparison.ranks.size(), 1U);
  EXPECT_THAT(comparison.ranks.front().names, ElementsAre("rvr", "real"));
  EXPECT_EQ(comparison.ranks.front().test.blocks, 6U);
  EXPECT_EQ(comparison.ranks.front().incomplete, 6U);
  EXPECT_EQ(comparison.ranks.front().test.mean_ranks[0], 1);
}

TEST(Comparison, OfOneDesignAGroupARunIsAValueAndSaysNothingOfMethods) {
  const Comparison comparison =
      compare(records_of({{.method = "a", .scores = {1, 2, 3}},
                          {.design = 2, .method = "b", .scores = {2, 3, 4}}}),
              {.by = CompareBy::Method});
  EXPECT_EQ(comparison.unit, ScoreUnit::Run);
  EXPECT_EQ(comparison.pairs.front().n_first, 3U);
  EXPECT_THAT(comparison.notes, Contains(HasSubstr("each group is one design")));
  EXPECT_EQ(comparison.said, "a value is a run, out of the designs' tests");
}

TEST(Comparison, IntervalsOfRanksEndWhereRanksEnd) {
  auto designs = of_two_methods();
  for (int i = 1; i <= 3; ++i) {
    for (Scored design : of_two_methods()) {
      design.mission = "m" + std::to_string(i);
      design.design += 100 * i;
      if (i == 3) design.method = design.method == "better" ? "worse" : "better";
      designs.push_back(design);
    }
  }
  const Comparison comparison = compare(records_of(designs), {.by = CompareBy::Method});
  const FriedmanTest& test = comparison.ranks.front().test;
  ASSERT_GT(*test.half_width, 0.75);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_EQ(test.interval(i)->low, 1);
    EXPECT_EQ(test.interval(i)->high, 2);
  }
}

TEST(Comparison, WhatHasNothingBesideItIsSaid) {
  const Comparison comparison = compare(records_of({{.scores = {1}}, {.design = 2, .scores = {2}}}),
                                        {.by = CompareBy::Method});
  EXPECT_THAT(
      comparison.notes,
      ElementsAre("all scores have the same method watermelon: there is nothing to compare"));
}

TEST(Comparison, TestsThatRHasNoPForSayWhy) {
  const Comparison comparison = compare(
      records_of({{.method = "a", .scores = {3}}, {.design = 2, .method = "b", .scores = {3}}}),
      {.by = CompareBy::Method});
  const ComparedPair& pair = comparison.pairs.front();
  EXPECT_FALSE(pair.test.p_value);
  EXPECT_FALSE(pair.p_holm);
  EXPECT_THAT(pair.notes, ElementsAre("all values are the same: no p",
                                      "an interval of one value has no width"));
}

TEST(Comparison, TakesWhatTheOptionsAskFor) {
  auto designs = of_two_methods();
  designs.push_back({.design = 1, .method = "better", .scores = {99}, .purpose = "score"});
  const auto records = records_of(designs);
  EXPECT_EQ(compare(records, {.choice = {.purpose = "score", .unit = {}}}).groups.front().runs, 1U);
  EXPECT_EQ(compare(records, {.choice = {.purpose = "test", .unit = {}}}).groups.front().runs, 5U);
  EXPECT_EQ(compare(records, {.choice = {.purpose = "all", .unit = {}}}).groups.front().runs, 6U);
  EXPECT_EQ(compare(records, {}).groups.front().runs, 5U) << "tests, where there are some";
  EXPECT_EQ(compare(records, {}).said, "a value is a design: the mean of its tests");
  EXPECT_EQ(compare(records, {.method = "worse"}).groups.size(), 1U);
  EXPECT_THAT(compare(records, {.missions = {"grid"}}).groups, IsEmpty());
  EXPECT_THAT(compare(records, {.source = "real"}).groups, IsEmpty());
}

}  // namespace
}  // namespace swarmsmith
