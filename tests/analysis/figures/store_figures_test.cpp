#include <algorithm>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/figures/figure.h"
#include "analysis/figures/scatter_plot.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"
#include "tests/support/drawn_page.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

/// The makers on a store: two designs of two missions, three iterations of seven steps.
struct StoreFigures : FilledStore {
  Expected<Figure> make(std::string_view kind, const FigureOptions& options) {
    const FigureKind* found = find_figure_kind(kind);
    if (found == nullptr) return bad_input("no such kind");
    return found->make(*reader, options);
  }

  /// Of a figure that has to be there.
  Figure made(std::string_view kind, const FigureOptions& options = {.filter = {.design = {{1}}}}) {
    return value_of(make(kind, options));
  }

  std::string refusal(std::string_view kind, const FigureOptions& options) {
    const auto figure = make(kind, options);
    EXPECT_FALSE(figure);
    if (figure) return "";
    EXPECT_EQ(figure.error().kind, ErrorKind::BadInput);
    return figure.error().message;
  }
};

std::size_t rows_of(const std::string& csv) {
  return static_cast<std::size_t>(std::ranges::count(csv, '\n')) - 1;
}

TEST_F(StoreFigures, EveryKindGivesTheSameBytesAgainWithTextsThatStandClear) {
  for (const char* kind : {"convergence", "race", "sampling", "parallel"}) {
    for (const double width : {84.0, 174.0}) {
      const FigureOptions options{.filter = {.design = {{2}}}, .width_mm = width};
      const Figure figure = made(kind, options);
      EXPECT_EQ(figure.svg, made(kind, options).svg) << kind;
      EXPECT_EQ(figure.csv, made(kind, options).csv) << kind;
      EXPECT_THAT(drawn_page(figure.svg).collisions(), IsEmpty()) << kind << " " << width;
      EXPECT_LT(figure.svg.size(), 200'000U) << kind;
      EXPECT_GT(rows_of(figure.csv), 5U) << kind;
    }
  }
}

TEST_F(StoreFigures, RaceHasACellAScoreAndALineADroppedCandidate) {
  const FigureOptions options{.filter = {.design = {{1}}}, .iteration = 2};
  const Figure figure = made("race", options);
  const auto cells = race_cells(*reader, DesignId{1}, 2);
  EXPECT_EQ(rows_of(figure.csv), cells->size());
  const auto dropped = eliminations(*reader, DesignId{1}, 2);
  const auto by_test = std::ranges::count(*dropped, "test", &EliminationRecord::reason);
  ASSERT_GT(by_test, 0);
  const DrawnPage page = drawn_page(figure.svg);
  EXPECT_EQ(page.bars_of("#d55e00").size(), static_cast<std::size_t>(by_test));
  EXPECT_EQ(page.bars_of("#222222").size(), 3U + 3U);  // elites before and after
  EXPECT_THAT(figure.svg, HasSubstr("iteration 2 of design d1"));
}

TEST_F(StoreFigures, ARaceThatGoesOnIsDrawnAsFarAsItIs) {
  const SyntheticCampaign campaign = synthetic_campaign({.designs = 1, .iterations = 2});
  auto store = open_store(folder / "part.db", campaign);
  // An iteration is a batch for its beginning, one a step, and one for its elites.
  for (std::size_t batch = 0; batch < 1 + 7 + 1 + 1 + 6; ++batch)
    store->append(campaign.batches[batch]);
  store.reset();
  reader = open_reader(folder / "part.db");
  const Figure figure = made("race", {});
  EXPECT_THAT(figure.svg, HasSubstr("iteration 2 (still running)"));
  {
    auto again = open_store(folder / "part.db", campaign);
    again->append({DesignStateRow{.design = {1}, .state = DesignState::Stopped}});
  }
  reader = open_reader(folder / "part.db");
  EXPECT_THAT(made("race", {}).svg, HasSubstr("iteration 2 (stopped)"));
  const DrawnPage page = drawn_page(figure.svg);
  EXPECT_EQ(page.bars_of("#222222").size(), 3U);  // elites of before alone
  EXPECT_THAT(page.collisions(), IsEmpty());
  EXPECT_GT(rows_of(made("parallel", {}).csv), 5U);
  // Before the first step there is nothing to draw, and that is said.
  auto begun = open_store(folder / "begun.db", campaign);
  begun->append(campaign.batches[0]);
  begun.reset();
  reader = open_reader(folder / "begun.db");
  for (const char* kind : {"race", "parallel", "convergence"}) {
    EXPECT_EQ(why_not(make(kind, {})).kind, ErrorKind::NotFound) << kind;
  }
}

TEST_F(StoreFigures, RaceRowsAreInTheOrderOfHowFarTheyCame) {
  const DrawnPage page =
      drawn_page(made("race", {.filter = {.design = {{1}}}, .iteration = 3}).svg);
  const auto kept = elites(*reader, {.design = DesignId{1}});
  std::vector<std::string> names;
  for (const auto& text : page.texts)
    if (text.text.starts_with("c") && text.text.find(' ') == std::string::npos)
      names.push_back(text.text);
  ASSERT_GE(names.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(std::ranges::any_of(*kept, [&](const EliteRecord& elite) {
      return elite.iteration == 3 && to_string(elite.candidate) == names[i];
    })) << names[i];
  }
}

TEST_F(StoreFigures, RaceShowsTheLastIterationUnlessToldOtherwise) {
  EXPECT_EQ(made("race").svg, made("race", {.filter = {.design = {{1}}}, .iteration = 3}).svg);
  EXPECT_NE(made("race").svg, made("race", {.filter = {.design = {{1}}}, .iteration = 1}).svg);
  EXPECT_EQ(refusal("race", {.filter = {.design = {{1}}}, .iteration = 9}),
            "--iteration 9: d1 has raced the iterations 1 to 3");
}

TEST_F(StoreFigures, OneOfSeveralDesignsHasToBeNamed) {
  for (const char* kind : {"race", "sampling", "parallel"}) {
    EXPECT_THAT(refusal(kind, {}), HasSubstr("--design d1")) << kind;
    // A mission that has one design is enough.
    EXPECT_TRUE(make(kind, {.filter = {.mission = "aggregation"}})) << kind;
    EXPECT_EQ(why_not(make(kind, {.filter = {.design = {{7}}}})).kind, ErrorKind::NotFound) << kind;
  }
}

TEST_F(StoreFigures, SamplingCountsEveryCandidateOfAnIteration) {
  const Figure figure =
      made("sampling", {.filter = {.design = {{1}}}, .parameter = "NumStates,RWM0"});
  // Eight candidates an iteration; each has a number of states.
  std::int64_t counted = 0;
  for (std::size_t at = figure.csv.find("1,NumStates,1,8,value,"); at != std::string::npos;
       at = figure.csv.find("1,NumStates,1,8,value,", at + 1)) {
    const std::size_t count = figure.csv.find(",,,", at) + 3;
    counted += std::stoll(figure.csv.substr(count));
  }
  EXPECT_EQ(counted, 8);
  EXPECT_THAT(figure.csv, HasSubstr("1,NumStates,1,8,not active,,,,0\n"));
  EXPECT_THAT(figure.csv, HasSubstr("1,NumStates,1,8,elite,"));
  EXPECT_THAT(refusal("sampling", {.filter = {.design = {{1}}}, .parameter = "speed"}),
              HasSubstr("NumConnections0"));
}

TEST_F(StoreFigures, SamplingChoosesTwelveAndSaysByWhichRule) {
  const Figure figure = made("sampling");
  EXPECT_THAT(figure.svg, HasSubstr("moved most between the first and the last third"));
  EXPECT_THAT(figure.svg, testing::ContainsRegex("The 12 of [0-9]+ parameters"));
}

TEST_F(StoreFigures, ParallelHasEveryEliteAndNamedParametersInTheirOrder) {
  const Figure figure =
      made("parallel", {.filter = {.design = {{1}}}, .parameter = "RWM0,NumStates"});
  EXPECT_EQ(rows_of(figure.csv), 2U * 24);  // 24 candidates, two parameters
  const auto kept = elites(*reader, {.design = DesignId{1}});
  for (const EliteRecord& elite : *kept) {
    if (elite.iteration != 3) continue;
    EXPECT_THAT(figure.csv, HasSubstr(fmt::format("1,{},1,", elite.candidate.value)));
  }
  EXPECT_LT(figure.csv.find("RWM0"), figure.csv.find("NumStates"));
}

TEST_F(StoreFigures, ImportanceRatesEachParameterOfEnoughCandidates) {
  const Figure figure = made("importance");
  // 24 candidates: what all of them have can be rated.
  EXPECT_THAT(figure.csv, HasSubstr("\n1,NumStates,24,"));
  EXPECT_THAT(drawn_page(figure.svg).collisions(), IsEmpty());
  EXPECT_THAT(refusal("importance", {}), HasSubstr("--design d1"));
}

TEST_F(StoreFigures, TrainingHasAPointAWinner) {
  const Figure figure = made("training", {});
  EXPECT_EQ(rows_of(figure.csv), 2U);
  EXPECT_THAT(drawn_page(figure.svg).collisions(), IsEmpty());
  const auto all = designs(*reader, {});
  EXPECT_THAT(figure.csv, HasSubstr(fmt::format("{},rvr,4,", *all->front().best_mean)));
}

TEST(ScatterPlots, OfThreeMissionsFitOnAPageAndLineUp) {
  ScatterPlot plot{.title = "Training and test", .details = {"a", "b"}, .width_mm = 85};
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = i == 2 ? -400'000 : 1;
    plot.panels.push_back({std::string(1, static_cast<char>('a' + i)), {{value, 2 * value, i}}});
    plot.groups.emplace_back(i, "method");
  }
  for (std::size_t i = 3; i < 7; ++i)
    plot.groups.emplace_back(i, "another method");
  for (const double width : {85.0, 174.0}) {
    plot.width_mm = width;
    const DrawnPage page = drawn_page(draw(plot));
    EXPECT_LE(page.height, kFigurePage_mm) << width;
    EXPECT_THAT(page.collisions(), IsEmpty()) << width;
  }
}

TEST_F(StoreFigures, AxesHaveTheNamesOfModules) {
  for (const char* kind : {"sampling", "parallel"}) {
    const Figure figure = made(kind, {.filter = {.design = {{1}}}, .parameter = "S0,RWM0"});
    std::string texts;
    for (const auto& text : drawn_page(figure.svg).texts)
      texts += text.text + "\n";
    EXPECT_THAT(texts, HasSubstr("behaviour 0")) << kind;
    EXPECT_THAT(texts, testing::ContainsRegex("exploration[ \n]tau 0")) << kind;
    EXPECT_THAT(figure.csv, HasSubstr(",RWM0,")) << kind;  // as the store has them
  }
}

TEST_F(StoreFigures, GapSaysWhatIsMissing) {
  const Error none = why_not(make("gap", {}));
  EXPECT_EQ(none.kind, ErrorKind::NotFound);
  EXPECT_THAT(none.message, HasSubstr("one source alone (rvr)"));
}

TEST_F(StoreFigures, OfAPaperHaveNoTitleNorDetails) {
  for (const FigureKind& kind : not_empty(figure_kinds())) {
    // They draw other stores than this one.
    if (kind.name == "machine" || kind.name == "gap" || kind.name == "ranks" ||
        kind.name == "ablation") {
      continue;
    }
    FigureOptions options{.filter = {.design = {{1}}}};
    if (refused_option(kind, options)) options.filter.design.reset();
    const Figure plain = made(kind.name, options);
    options.paper = true;
    const Figure paper = made(kind.name, options);
    EXPECT_EQ(paper.csv, plain.csv) << kind.name;
    EXPECT_THAT(paper.svg, HasSubstr("<title></title>")) << kind.name;
    EXPECT_LT(drawn_page(paper.svg).texts.size(), drawn_page(plain.svg).texts.size()) << kind.name;
    EXPECT_THAT(drawn_page(paper.svg).collisions(), IsEmpty()) << kind.name;
  }
}

TEST_F(StoreFigures, ConvergenceHasAPanelAMission) {
  const DrawnPage page = drawn_page(made("convergence", {}).svg);
  EXPECT_TRUE(page.has_text("aggregation (robots)"));
  EXPECT_TRUE(page.has_text("color selection (reward)"));
  EXPECT_EQ(rows_of(made("convergence", {}).csv), 2U * 3 * 3);
}

}  // namespace
}  // namespace swarmsmith
