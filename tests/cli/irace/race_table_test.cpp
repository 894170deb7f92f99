#include "cli/irace/race_table.h"

#include <gmock/gmock.h>

namespace swarmsmith::cli {
namespace {

// Lines that R's irace printed.
TEST(RaceTable, HasTheLinesOfIrace) {
  EXPECT_EQ(race_headline(false),
            "+-+-----------+-----------+-----------+----------------+-----------+--------+-----+"
            "----+------+\n"
            "| |   Instance|      Alive|       Best|       Mean best| Exp so far|  W time|  rho|"
            "KenW|  Qvar|\n"
            "+-+-----------+-----------+-----------+----------------+-----------+--------+-----+"
            "----+------+\n");
  EXPECT_EQ(race_line({.pair = 1, .marker = 'x', .alive_after = 8, .best = {8}, .mean_best = -14.5},
                      8, 0.3, false),
            "|x|          1|          8|          8|     14.50000000|          8|00:00:00|   NA|"
            "  NA|    NA|\n");
  EXPECT_EQ(race_line({.pair = 5,
                       .marker = '-',
                       .alive_after = 3,
                       .best = {10},
                       .mean_best = -25.04,
                       .kendall_w = 0.04,
                       .spearman_rho = -0.2,
                       .qvar = 0.8298},
                      70, 3725, false),
            "|-|          5|          3|         10|     25.04000000|         70|01:02:05|-0.20|"
            "0.04|0.8298|\n");
}

TEST(RaceTable, HasAColumnForBounds) {
  EXPECT_EQ(race_line({.pair = 2,
                       .marker = 'c',
                       .alive_after = 13,
                       .best = {4},
                       .mean_best = -0.8,
                       .bound = 0.29},
                      27, std::nullopt, true),
            "|c|          2|    0.29|         13|          4|    0.8000000000|         27|      NA|"
            "   NA|  NA|    NA|\n");
  EXPECT_EQ(race_rule(true),
            "+-+-----------+--------+-----------+-----------+----------------+-----------+--------+"
            "-----+----+------+\n");
}

TEST(RaceTable, NamesTheBestAsIraceDoes) {
  EXPECT_EQ(best_so_far(11, 36.1666666666666),
            "Best-so-far configuration:          11    mean value:      36.16666667\n");
}

TEST(RaceTable, ExplainsEachMarker) {
  for (const char marker : std::string("xc-=!.:"))
    EXPECT_THAT(marker_legend(), testing::HasSubstr(std::string("\n     ") + marker + " "));
}

}  // namespace
}  // namespace swarmsmith::cli
