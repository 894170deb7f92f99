#include "analysis/figures/rank_plot.h"

#include "analysis/figures/figure.h"
#include "tests/analysis/support/svg_texts.h"
#include "tests/storage/fixture.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

RankPlot plot_of(std::size_t rows) {
  RankPlot plot{.title = "Ranks by method"};
  RankPlot::Panel panel{
      .title = "pseudo-reality",
      .details = {"30 repetitions: aggregation, grid exploration, color selection",
                  "Friedman: \u03c7\u00b2 = 8.373, df 2, p = 0.0152"}};
  for (std::size_t i = 0; i < rows; ++i) {
    const auto rank = static_cast<double>(i + 1);
    panel.rows.push_back({"a method with a long name " + std::to_string(i), rank,
                          std::pair(rank - 0.6, rank + 0.6)});
  }
  plot.panels = {panel, panel};
  return plot;
}

TEST(RankPlot, TextsStandClearOfEachOtherAtEveryWidth) {
  for (const std::size_t rows : {2U, 3U, 7U, 12U}) {
    for (const double width : {60.0, 84.0, 180.0}) {
      RankPlot plot = plot_of(rows);
      plot.width_mm = width;
      const std::string svg = draw(plot);
      EXPECT_THAT(text_problems(svg), IsEmpty()) << rows << " rows, " << width << " mm";
      EXPECT_THAT(shape_problems(svg), IsEmpty()) << rows << " rows, " << width << " mm";
    }
  }
}

TEST(RankPlot, TheBestStandsOnTop) {
  RankPlot plot{.title = "t", .panels = {{.rows = {{"worse", 1.8}, {"better", 1.2}}}}};
  const std::string svg = draw(plot);
  EXPECT_LT(svg.find("better"), svg.find("worse"));
}

/// Eight designs: two of each of two methods in each of two missions.
struct RanksFigureTest : testing::Test {
  TemporaryFolder folder;

  std::unique_ptr<StoreReader> store_with(const std::string& first, const std::string& second) {
    SyntheticCampaign campaign = synthetic_campaign({.designs = 8});
    for (DesignRow& design : campaign.designs) {
      design.mission = design.id.value <= 4 ? "aggregation" : "grid_exploration";
      design.method = design.id.value % 2 == 1 ? first : second;
    }
    fill_store(folder / "s.db", campaign);
    return open_reader(folder / "s.db");
  }

  static Expected<Figure> make(StoreReader& store, const FigureOptions& options) {
    return find_figure_kind("ranks")->make(store, options);
  }
};

TEST_F(RanksFigureTest, RanksMethodsWhereThereAreSeveral) {
  const auto store = store_with("chocolate", "watermelon");
  const auto figure = value_of(make(*store, {}));
  EXPECT_THAT(figure.svg, HasSubstr("Ranks by method"));
  EXPECT_THAT(figure.svg, HasSubstr("2 missions in rvr: aggregation"));
  EXPECT_THAT(figure.svg, HasSubstr("chocolate"));
  EXPECT_THAT(figure.csv, HasSubstr("\nrvr,chocolate,"));
  EXPECT_THAT(text_problems(figure.svg), IsEmpty());
  EXPECT_EQ(figure.svg, make(*store, {})->svg);
}

TEST_F(RanksFigureTest, SaysNothingOfADifferenceThatTheTestDoesNotShow) {
  const auto store = store_with("chocolate", "watermelon");  // two missions: p is 0.157 at least
  const std::string svg = make(*store, {})->svg;
  EXPECT_THAT(svg, HasSubstr("No difference is found at 5 %"));
  EXPECT_THAT(svg, Not(HasSubstr("do not overlap")));
}

TEST_F(RanksFigureTest, SaysWhyThereIsNothingToRank) {
  const auto store = store_with("watermelon", "watermelon");
  const Error figure = why_not(make(*store, {}));
  EXPECT_EQ(figure.kind, ErrorKind::NotFound);
  EXPECT_THAT(figure.message, HasSubstr("all scores have the same source rvr"));
  EXPECT_THAT(make(*store, {.by = "method"}).error().message,
              HasSubstr("the same method watermelon"));
  EXPECT_EQ(make(*store, {.by = "mission"}).error().kind, ErrorKind::BadInput);
}

TEST_F(RanksFigureTest, SaysNothingOfTheTestsBetweenGroups) {
  const auto store = store_with("chocolate", "watermelon");
  const auto figure = make(*store, {.filter = {.mission = "aggregation"}, .by = "method"});
  ASSERT_FALSE(figure);
  EXPECT_EQ(figure.error().message,
            "there is nothing to rank: rvr: no ranks, since fewer than two missions have designs "
            "of every method; within a mission the tests of `compare` compare them");
}

}  // namespace
}  // namespace swarmsmith
