#include <algorithm>
#include <set>
#include <string>
#include <variant>

#include <fmt/ranges.h>

#include "analysis/drawing/svg.h"
#include "analysis/figures/figure.h"
#include "tests/analysis/support/svg_texts.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

std::ptrdiff_t rows_of(const Figure& figure) {
  return std::ranges::count(figure.csv, '\n') - 1;
}

/// A store of four designs, each tested by simulation and run once on robots.
struct FigureKinds : testing::Test {
  TemporaryFolder folder;
  SyntheticCampaign campaign = synthetic_campaign({.designs = 4, .iterations = 3});
  std::unique_ptr<StoreReader> reader;

  FigureKinds() {
    auto store = filled_store(folder / "s.db", campaign);
    store->flush();
    const auto known = designs(*open_reader(folder / "s.db"), {});
    for (const DesignRecord& design : *known) {
      store->append({PairRow{design.design, Purpose::Score, 1, 1, 77},
                     EvaluationRow{.key = {*design.best, Purpose::Score, 1},
                                   .measured = {.score = static_cast<double>(design.design.value)},
                                   .source = "real"}});
    }
    store.reset();
    reader = open_reader(folder / "s.db");
  }

  Figure made(std::string_view kind, const FigureOptions& options = {}) {
    const FigureKind* found = find_figure_kind(kind);
    EXPECT_NE(found, nullptr) << kind;
    auto figure = found->make(*reader, options);
    EXPECT_TRUE(figure) << kind << ": " << (figure ? "" : to_string(figure.error()));
    return figure ? *figure : Figure{};
  }

  Error refusal(std::string_view kind, const FigureOptions& options) {
    const auto figure = find_figure_kind(kind)->make(*reader, options);
    EXPECT_FALSE(figure);
    return figure ? Error{} : figure.error();
  }
};

TEST_F(FigureKinds, AreDrawnWithoutTextOverTextAtEveryWidth) {
  for (const char* kind : {"box", "scores", "modules", "convergence"}) {
    for (const double width : {60.0, 84.0, 175.0}) {
      const Figure figure = made(kind, {.width_mm = width});
      EXPECT_THAT(figure.svg, StartsWith("<svg "));
      EXPECT_THAT(text_problems(figure.svg), IsEmpty()) << kind << " " << width;
      EXPECT_THAT(shape_problems(figure.svg), IsEmpty()) << kind << " " << width;
      EXPECT_LT(figure.svg.size(), 200'000U);
      EXPECT_GT(rows_of(figure), 0);
      EXPECT_EQ(figure.svg, made(kind, {.width_mm = width}).svg);
    }
  }
}

const ScoreChoice kRuns{.purpose = "", .unit = ScoreUnit::Run};

TEST_F(FigureKinds, BoxHasAPointForEachRowOfItsTable) {
  // A design in each of its two sources.
  const Figure figure = made("box");
  EXPECT_EQ(rows_of(figure), 4 * 2);
  EXPECT_EQ(dots_in(figure.svg), 8U);
  const Figure runs = made("box", {.choice = kRuns});
  EXPECT_EQ(rows_of(runs), 4 * (4 + 1));
  EXPECT_EQ(dots_in(runs.svg), 20U);
  const Figure real = made("box", {.source = "real"});
  EXPECT_EQ(rows_of(real), 4);
  EXPECT_THAT(real.csv, Not(HasSubstr(",rvr,")));
  EXPECT_EQ(rows_of(made("box", {.filter = {.design = DesignId{2}}})), 5);
  const Figure tests = made("box", {.choice = {.purpose = "test", .unit = ScoreUnit::Run}});
  const Figure later = made("box", {.choice = {.purpose = "score", .unit = ScoreUnit::Run}});
  EXPECT_EQ(rows_of(tests), 4 * 4);
  EXPECT_EQ(rows_of(later), 4);
}

TEST_F(FigureKinds, GroupsNeverMixSources) {
  for (const char* by : {"source", "method", "mission"}) {
    const auto texts = texts_of(made("box", {.by = by, .choice = kRuns}).svg);
    // Two missions, each with a box a source; by method they are a pair of one name.
    const bool are_pairs = by == std::string("method");
    EXPECT_EQ(std::ranges::count(texts, "rvr", &TextBox::text), are_pairs ? 0 : 2) << by;
    EXPECT_EQ(std::ranges::count(texts, "real", &TextBox::text), are_pairs ? 0 : 2) << by;
    EXPECT_EQ(std::ranges::count(texts, "narrow boxes: rvr; wide boxes: real", &TextBox::text),
              are_pairs ? 1 : 0);
    EXPECT_EQ(std::ranges::count(texts, "8", &TextBox::text), 2) << by;
  }
}

TEST_F(FigureKinds, ASourceHasItsColourWhateverElseIsDrawn) {
  // In alphabetical order with `real` last: rvr has the first colour, real the second.
  EXPECT_THAT(made("box", {.by = "source", .source = "rvr"}).svg, HasSubstr(distinct_color(0)));
  EXPECT_THAT(made("box", {.by = "source", .source = "real"}).svg, HasSubstr(distinct_color(1)));
  EXPECT_THAT(made("scores", {.by = "source", .source = "real"}).svg, HasSubstr(distinct_color(1)));
}

TEST_F(FigureKinds, AGapWithoutAnyChangeSaysThatThereIsNothingToTest) {
  auto store = filled_store(folder / "same.db", campaign);
  for (const auto& batch : campaign.batches) {
    for (const Row& row : batch) {
      if (const auto* pair = std::get_if<PairRow>(&row)) {
        PairRow again = *pair;
        again.purpose = Purpose::Score;
        if (pair->purpose == Purpose::Test) store->append({again});
      } else if (const auto* run = std::get_if<EvaluationRow>(&row)) {
        EvaluationRow again = *run;
        again.key.purpose = Purpose::Score;
        again.source = "other";
        if (run->key.purpose == Purpose::Test) store->append({again});
      }
    }
  }
  store.reset();
  reader = open_reader(folder / "same.db");
  std::string words;
  for (const TextBox& text : texts_of(made("gap", {.width_mm = 174}).svg))
    words += text.text + " ";
  EXPECT_THAT(words, AllOf(HasSubstr("rvr to other, mean change +0, no differences to test"),
                           Not(HasSubstr("too few"))));
}

TEST_F(FigureKinds, ModulesAreThoseOfTheView) {
  const Figure figure = made("modules");
  const auto rows = cells_of(*reader,
                             "SELECT mission, module, avg_occurrences, occurrence_rate,"
                             " avg_reachable, reachable_rate FROM v_module_frequency"
                             " ORDER BY mission, module");
  EXPECT_EQ(rows_of(figure), static_cast<std::ptrdiff_t>(rows.size()));
  for (const auto& row : rows)
    EXPECT_THAT(figure.csv, HasSubstr(fmt::format("{},watermelon,{},2,{}\n", row[0], row[1],
                                                  fmt::join(row.begin() + 2, row.end(), ","))));
}

TEST_F(FigureKinds, MachinesWithoutANameAreASheetOfAllWinners) {
  const Figure sheet = made("machine", {.width_mm = 174});
  const auto winners =
      cells_of(*reader, "SELECT design, best_candidate FROM v_designs ORDER BY design");
  ASSERT_GT(winners.size(), 1U);
  for (const auto& row : winners) {
    EXPECT_THAT(sheet.csv, HasSubstr(fmt::format("\n{},{},0,", row[0], row[1])));
    EXPECT_THAT(sheet.svg, HasSubstr(fmt::format(">d{} c{}<", row[0], row[1])));
    EXPECT_THAT(sheet.tex, HasSubstr(fmt::format("% d{} c{}: ", row[0], row[1])));
    const Figure alone = made("machine", {.filter = {.design = DesignId{std::stoll(row[0])}}});
    EXPECT_THAT(alone.csv, StartsWith("state,behaviour"));
  }
  EXPECT_THAT(text_problems(sheet.svg), IsEmpty());
}

TEST_F(FigureKinds, WhatTheStoreDoesNotHaveIsSaid) {
  const Error source = refusal("scores", {.source = "rael"});
  EXPECT_EQ(source.kind, ErrorKind::BadInput);
  EXPECT_THAT(source.message, HasSubstr("did you mean \"real\""));
  for (const char* kind : {"box", "scores", "modules", "convergence"})
    EXPECT_EQ(refusal(kind, {.filter = {.mission = "none"}}).kind, ErrorKind::NotFound) << kind;
}

TEST(FigureOptionsOfKinds, ThatMeanNothingAreRefused) {
  const FigureKind* modules = find_figure_kind("modules");
  ASSERT_NE(modules, nullptr);
  EXPECT_FALSE(refused_option(*modules, {.filter = {.mission = "m", .method = "w"}}));
  const auto refused = value_of(refused_option(*modules, {.by = "source"}));
  EXPECT_EQ(refused.where, "--by");
  EXPECT_THAT(refused.message, HasSubstr("--width, --paper, --mission, --method"));
  EXPECT_TRUE(refused_option(*modules, {.iteration = 3}));
  EXPECT_TRUE(refused_option(*modules, {.candidate = CandidateId{3}}));
}

TEST(FigureKindNames, AreDifferentAndHaveASummary) {
  std::set<std::string_view> names;
  for (const FigureKind& kind : figure_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_FALSE(kind.summary.empty());
  }
  EXPECT_EQ(find_figure_kind("pie"), nullptr);
}

}  // namespace
}  // namespace swarmsmith
