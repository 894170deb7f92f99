#include "sim/control/labeler.h"

#include <gtest/gtest.h>

#include <vector>

namespace swarmsmith {
namespace {

const std::vector<Rgb> kLabels = {{0, 0, 0},   {127, 127, 127}, {255, 255, 255}, {255, 0, 0},
                                  {0, 255, 0}, {0, 0, 255},     {255, 255, 0}};

TEST(Labeler, GivesTheLabelWithTheSmallestSumOfSquares) {
  // d to grey 27^2 + 17^2 + 37^2 = 2387, to black 30200.
  EXPECT_EQ(nearest_label({100, 110, 90}, kLabels), (Rgb{127, 127, 127}));
  // To red 55^2 + 60^2 + 0 = 6625; to black 43600, to grey 36747.
  EXPECT_EQ(nearest_label({200, 60, 0}, kLabels), (Rgb{255, 0, 0}));
  // To yellow 55^2 + 105^2 + 20^2 = 14450; to red 25925, to grey 17307.
  EXPECT_EQ(nearest_label({200, 150, 20}, kLabels), (Rgb{255, 255, 0}));
  for (const Rgb label : kLabels)
    EXPECT_EQ(nearest_label(label, kLabels), label);
}

TEST(Labeler, SquaresTheDifferences) {
  // |d| sums are 30 and 28, their squares 300 and 784: with sums the second would win.
  const std::vector<Rgb> labels = {{10, 10, 10}, {28, 0, 0}};
  EXPECT_EQ(nearest_label({0, 0, 0}, labels), labels[0]);
}

TEST(Labeler, TheFirstLabelWinsATie) {
  EXPECT_EQ(nearest_label({1, 0, 0}, std::vector<Rgb>{{0, 0, 0}, {2, 0, 0}}), (Rgb{0, 0, 0}));
  EXPECT_EQ(nearest_label({1, 0, 0}, std::vector<Rgb>{{2, 0, 0}, {0, 0, 0}}), (Rgb{2, 0, 0}));
}

TEST(Labeler, WithoutLabelsLeavesTheReading) {
  EXPECT_EQ(nearest_label({1, 2, 3}, {}), (Rgb{1, 2, 3}));
}

}  // namespace
}  // namespace swarmsmith
