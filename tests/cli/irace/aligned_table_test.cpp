#include "cli/irace/aligned_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace swarmsmith::cli {
namespace {

using Cells = std::vector<std::string>;
using Reals = std::vector<std::optional<double>>;

// What R 4.2 prints of the same columns.
TEST(RealCells, HaveTheDecimalsThatRGivesThem) {
  EXPECT_EQ(real_cells(Reals{1234567.891, 0.5, 2}), (Cells{"1234567.9", "0.5", "2.0"}));
  EXPECT_EQ(real_cells(Reals{123456, 0.0001, 1}), (Cells{"123456.0000", "0.0001", "1.0000"}));
  EXPECT_EQ(real_cells(Reals{123456.1234, 2.0}), (Cells{"123456.1", "2.0"}));
  EXPECT_EQ(real_cells(Reals{33.3333333333, 1.0 / 7}), (Cells{"33.3333333", "0.1428571"}));
  EXPECT_EQ(real_cells(Reals{-1.5, 22}), (Cells{"-1.5", "22.0"}));
  EXPECT_EQ(real_cells(Reals{0, 3}), (Cells{"0", "3"}));
}

TEST(RealCells, AreScientificWhereThatIsShorter) {
  EXPECT_EQ(real_cells(Reals{1e6, std::nullopt, 3.0}), (Cells{"1e+06", "NA", "3e+00"}));
  EXPECT_EQ(real_cells(Reals{0.0001, 0.0002}), (Cells{"1e-04", "2e-04"}));
  EXPECT_EQ(real_cells(Reals{100000, 200000}), (Cells{"1e+05", "2e+05"}));
  EXPECT_EQ(real_cells(Reals{79.3, 1e6}), (Cells{"7.93e+01", "1.00e+06"}));
}

TEST(RealCells, ShowWhatIsNoNumber) {
  EXPECT_EQ(real_cells(Reals{std::nullopt, HUGE_VAL, -HUGE_VAL, 2}),
            (Cells{"NA", "Inf", "-Inf", "2"}));
}

TEST(AlignedTable, IsADataFrameOfR) {
  EXPECT_EQ(aligned_table({"1", "10", "100"}, {{"a", {"1e+06", "NA", "3e+00"}},
                                               {"c", {"x", "<NA>", "long value"}},
                                               {"wide name", {"1", "2", "3"}}}),
            "        a          c wide name\n"
            "1   1e+06          x         1\n"
            "10     NA       <NA>         2\n"
            "100 3e+00 long value         3\n");
}

TEST(AlignedTable, CountsCharactersAndNotBytes) {
  EXPECT_EQ(aligned_table({"1", "2"}, {{"c", {"\xc3\xa4\xc3\xb6", "abc"}}}),
            "    c\n1  \xc3\xa4\xc3\xb6\n2 abc\n");
}

}  // namespace
}  // namespace swarmsmith::cli
