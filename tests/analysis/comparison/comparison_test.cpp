#include "analysis/comparison/comparison.h"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

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
}

TEST(Comparison, OfRunsSaysHowFarTheyAreIndependent) {
  const std::string overstated =
      "runs of one design are not independent of each other: these tests overstate the certainty";
  const std::string of_machines =
      "each group is one design: these tests tell machines apart, and say nothing about the "
      "methods that made them";
  struct Case {
    std::string what;
    std::vector<std::vector<double>> first;  ///< scores of each design
    std::vector<std::vector<double>> second;
    std::vector<std::string> notes;
  };
  for (const auto& [what, first, second, notes] : std::vector<Case>{
           {"one design each", {{1, 2, 3}}, {{2, 3, 4}}, {of_machines}},
           {"one run of each design", {{1}, {2}}, {{3}, {4}}, {}},
           {"several runs of one of the designs", {{1}, {2, 2}}, {{3}}, {overstated}},
       }) {
    std::vector<Scored> designs;
    for (const auto& scores : first)
      designs.push_back({.design = std::ssize(designs) + 1, .method = "a", .scores = scores});
    for (const auto& scores : second)
      designs.push_back({.design = std::ssize(designs) + 1, .method = "b", .scores = scores});
    const auto notes_of = [&](ScoreUnit unit) {
      const ComparisonOptions options{.by = CompareBy::Method,
                                      .choice = {.purpose = "", .unit = unit}};
      std::vector<std::string> all = compare(records_of(designs), options).notes;
      std::erase_if(all, [](const std::string& note) { return note.starts_with("rvr: no ranks"); });
      return all;
    };
    EXPECT_EQ(notes_of(ScoreUnit::Run), notes) << what;
    EXPECT_THAT(notes_of(ScoreUnit::Design), IsEmpty()) << what;
  }
}

/// Designs of three methods and missions under two profiles, on the seeds 1 and 2 under rvr. Under
/// the other profile the 6 designs of "later" and the 3 of the grid ran on the seeds 2 and 3.
std::vector<DesignScore> under_two_profiles() {
  std::vector<Scored> designs;
  for (int i = 1; i <= 12; ++i) {
    Scored design{.design = i, .method = "same", .repetition = i, .scores = {1.0 * i, 2.0 * i}};
    if (i <= 6) design.method = "later";
    if (i > 9) design.mission = "grid";
    designs.push_back(design);
    design.source = "pseudo-reality";
    design.scores = {0.5 * i, 1.5 * i};
    design.purpose = "score";
    design.first_seed = i <= 6 || i > 9 ? 2 : 1;
    designs.push_back(design);
  }
  return records_of(designs);
}

std::string note_on_seeds(const std::string& designs) {
  return "the seeds of pseudo-reality and rvr differ in " + designs +
         " designs, so part of the difference may come from the seeds";
}

TEST(Comparison, SaysWhichPairedDesignsRanOnOtherSeeds) {
  const Comparison comparison = compare(under_two_profiles(), {.by = CompareBy::Source});
  ASSERT_EQ(comparison.pairs.size(), 3U) << "only pairs of sources";
  EXPECT_THAT(comparison.pairs[0].notes, Contains(note_on_seeds("6 of 6")));
  EXPECT_THAT(comparison.pairs[1].notes, Not(Contains(HasSubstr("seeds"))));
  EXPECT_THAT(comparison.pairs[2].notes, Contains(note_on_seeds("3 of 3")));
  EXPECT_THAT(comparison.seeds, ElementsAre(note_on_seeds("9 of 12")));
  EXPECT_THAT(paper_sentences(comparison).front().text, HasSubstr(note_on_seeds("6 of 6")));
}

TEST(Comparison, RunsHaveNoNoteOnSeedsSinceTheyArePairedByThem) {
  const Comparison comparison =
      compare(under_two_profiles(),
              {.by = CompareBy::Source, .choice = {.purpose = "", .unit = ScoreUnit::Run}});
  ASSERT_EQ(comparison.pairs.size(), 3U);
  for (const ComparedPair& pair : comparison.pairs)
    EXPECT_THAT(pair.notes, Not(Contains(HasSubstr("the seeds"))));
  EXPECT_THAT(comparison.seeds, IsEmpty());
}

TEST(Comparison, DesignsInOneSourceAloneAreLeftOutAndCounted) {
  auto scores = in_two_sources();
  std::erase_if(scores, [](const DesignScore& score) {
    return score.design == DesignId{3} && score.source == "real";
  });
  const ComparedPair pair = compare(scores, {.by = CompareBy::Source}).pairs.front();
  EXPECT_EQ(pair.n_first, 5U);
  EXPECT_THAT(
      pair.notes,
      ElementsAre("n is too small: even the clearest difference would have an exact p of 0.0625",
                  "designs left out, since only one of the two sources has them: 1"));
}

const std::string kNarrow = "n is small: an interval of fewer than 10 values is too narrow";
const std::string kNoWidth = "an interval of one value has no width";

/// As many values, above each other.
std::vector<double> rising(std::size_t count, double from) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(from + static_cast<double>(i));
  return values;
}

// The least p is 2 / choose(m + n, m).
TEST(Comparison, ARankSumTestSaysWhatItsNumbersOfValuesAllow) {
  struct Case {
    std::size_t n_first;
    std::size_t n_second;
    std::vector<std::string> notes;
  };
  const std::string too_small = "n is too small: even the clearest difference would have an exact ";
  for (const auto& [n_first, n_second, notes] : std::vector<Case>{
           {1, 3, {kNoWidth, too_small + "p of 0.5"}},
           {3, 1, {kNoWidth, too_small + "p of 0.5"}},
           {2, 3, {too_small + "p of 0.2"}},
           {1, 39, {kNoWidth, too_small + "p of 0.05"}},  // only a p below 0.05 is a difference
           {1, 40, {kNoWidth}},
           {4, 4, {kNarrow}},
           {9, 10, {kNarrow}},
           {10, 9, {kNarrow}},
           {10, 10, {}},
       }) {
    const Comparison comparison =
        compare(records_of(two_methods(rising(n_first, 100.5), rising(n_second, 1))),
                {.by = CompareBy::Method, .choice = {.purpose = "", .unit = ScoreUnit::Design}});
    EXPECT_EQ(comparison.pairs.front().notes, notes) << n_first << " and " << n_second;
  }
}

// The least p is 2 / 2^n, where n is the number of differences other than zero.
TEST(Comparison, ASignedRankTestSaysWhatItDidNotUse) {
  const auto notes_of = [](const std::vector<double>& differences) {
    const std::vector<double> none(differences.size());
    return compare(records_of(on_robots_too(differences, none)), {}).pairs.front().notes;
  };
  EXPECT_THAT(notes_of(rising(10, 1)), IsEmpty());
  EXPECT_THAT(notes_of(rising(11, 0)),
              ElementsAre("differences of zero, which the test does not use: 1 of 11"));
  EXPECT_THAT(notes_of({0, 0, 1, 2, 3, 4, 5, 6}),
              ElementsAre(kNarrow, "differences of zero, which the test does not use: 2 of 8"));
  EXPECT_THAT(
      notes_of({0, 1, 2}),
      ElementsAre("differences of zero, which the test does not use: 1 of 3",
                  "n is too small: even the clearest difference would have an exact p of 0.5"));
  EXPECT_THAT(notes_of({0, 0, 0}), ElementsAre("all differences are zero: no p"));
}

TEST(Comparison, SourcesWithoutACommonValueAreNotCompared) {
  for (const auto& [unit, what] : std::vector<std::pair<ScoreUnit, std::string>>{
           {ScoreUnit::Design, "design"},
           {ScoreUnit::Run, "run of the same design, instance and seed"}}) {
    const Comparison comparison =
        compare(records_of({{.design = 1, .source = "rvr", .scores = {1}},
                            {.design = 2, .repetition = 2, .source = "real", .scores = {2}}}),
                {.by = CompareBy::Source, .choice = {.purpose = "", .unit = unit}});
    EXPECT_THAT(comparison.pairs, IsEmpty());
    EXPECT_THAT(comparison.notes,
                ElementsAre("aggregation, watermelon: rvr and real have no " + what +
                                " in common, so they are not compared",
                            "no ranks, since fewer than two designs have scores in every source"));
    EXPECT_THAT(comparison.unranked, ElementsAre(comparison.notes.back()));
  }
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

TEST(Comparison, IsHopelessIfTheCorrectionAlonePreventsEachDifference) {
  struct Case {
    std::size_t tests;
    double least_p;
    std::string p;
  };
  for (const auto& [tests, least_p, p] : std::vector<Case>{{1, 0.9, ""},
                                                           {2, 0.02, ""},
                                                           {2, 0.025, "0.05"},
                                                           {2, 0.04, "0.08"},
                                                           {3, 0.03, "0.09"},
                                                           {3, 0.5, "1"}}) {
    const auto note = hopeless(tests, least_p);
    EXPECT_EQ(note.value_or(""),
              p.empty() ? ""
                        : "too few values for " + std::to_string(tests) +
                              " tests together: after the correction even the clearest difference "
                              "would have a p of " +
                              p);
  }
}

// The least p of four values against four is 2 / choose(8, 4) = 0.0286.
TEST(Comparison, SaysOfWhichPairsTheCorrectionLeavesTooFewValues) {
  std::vector<Scored> designs;
  const auto add = [&](const char* mission, const std::vector<double>& first,
                       const std::vector<double>& second) {
    for (Scored design : two_methods(first, second)) {
      design.mission = mission;
      design.design += 10'000 * static_cast<std::int64_t>(mission[0]);
      designs.push_back(design);
    }
  };
  add("a", rising(4, 10), rising(4, 1));
  add("b", rising(4, 10), rising(4, 1));
  add("c", {3}, {1});
  // No p, so it does not count, although twenty values could give a very small one.
  add("d", std::vector<double>(20, 5), std::vector<double>(20, 5));
  const Comparison comparison = compare(records_of(designs), {.by = CompareBy::Method});
  ASSERT_EQ(comparison.pairs.size(), 4U);
  const std::string together =
      "too few values for 3 tests together: after the correction even the clearest difference "
      "would have a p of 0.0857";
  EXPECT_THAT(comparison.pairs[0].notes, ElementsAre(kNarrow, together));
  EXPECT_THAT(comparison.pairs[1].notes, ElementsAre(kNarrow, together));
  EXPECT_THAT(comparison.pairs[2].notes,
              ElementsAre(kNoWidth,
                          "n is too small: even the clearest difference would have an "
                          "exact p of 1"));
  EXPECT_THAT(comparison.pairs[3].notes, ElementsAre("all values are the same: no p"));
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

TEST(Comparison, OfOneDesignAGroupARunIsAValue) {
  const Comparison comparison =
      compare(records_of({{.method = "a", .scores = {1, 2, 3}},
                          {.design = 2, .method = "b", .scores = {2, 3, 4}}}),
              {.by = CompareBy::Method});
  EXPECT_EQ(comparison.unit, ScoreUnit::Run);
  EXPECT_EQ(comparison.pairs.front().n_first, 3U);
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
  struct Case {
    CompareBy by;
    std::vector<Scored> designs;
    std::string note;
  };
  for (const auto& [by, designs, note] : std::vector<Case>{
           {CompareBy::Method, designs_of("m", {1, 2}), "method m: there is nothing to compare"},
           {CompareBy::Source, designs_of("m", {1, 2}), "source rvr: there is nothing to compare"},
           {CompareBy::Source, two_methods({1, 2}, {3, 4}),
            "source rvr: there is nothing to compare; its methods differ: compare by method"},
       }) {
    const Comparison comparison = compare(records_of(designs), {.by = by});
    EXPECT_THAT(comparison.notes, ElementsAre("all scores have the same " + note));
    EXPECT_EQ(comparison.unranked, comparison.notes);
    EXPECT_THAT(comparison.pairs, IsEmpty());
  }
}

TEST(Comparison, KnowsTheSourceOfTheCampaignsOwnTests) {
  std::vector<Scored> designs = on_robots_too({1, 2}, {3, 4});
  for (Scored& design : designs)
    design.purpose = design.source == "real" ? "test" : "score";
  EXPECT_EQ(compare(records_of(designs), {}).tested, "real");
  EXPECT_EQ(compare(records_of(designs), {.source = "rvr"}).tested, "");
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
