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
  EXPECT_EQ(race_line({.marker = 'x',
                       .pair = 1,
                       .alive = 8,
                       .best = 8,
                       .mean_best = 14.5,
                       .used = 8,
                       .wall_s = 0.3},
                      false),
            "|x|          1|          8|          8|     14.50000000|          8|00:00:00|   NA|"
            "  NA|    NA|\n");
  EXPECT_EQ(race_line({.marker = '-',
                       .pair = 5,
                       .alive = 3,
                       .best = 10,
                       .mean_best = 25.04,
                       .used = 70,
                       .wall_s = 3725,
                       .spearman_rho = -0.2,
                       .kendall_w = 0.04,
                       .qvar = 0.8298},
                      false),
            "|-|          5|          3|         10|     25.04000000|         70|01:02:05|-0.20|"
            "0.04|0.8298|\n");
}

TEST(RaceTable, HasAColumnForBounds) {
  EXPECT_EQ(race_line({.marker = 'c',
                       .pair = 2,
                       .bound = 0.29,
                       .alive = 13,
                       .best = 4,
                       .mean_best = 0.8,
                       .used = 27},
                      true),
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
