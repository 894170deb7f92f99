#include "sim/engine/internal/normal_noise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/math.h"

namespace swarmsmith {
namespace {

constexpr int kDraws = 2'000'000;

TEST(NormalNoise, HasTheMomentsOfTheNormalDistribution) {
  const NormalNoise& noise = NormalNoise::instance();
  Rng streams(1);
  double sum = 0;
  double second = 0;
  double third = 0;
  double fourth = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = noise.draw(Rng(streams.next()));
    sum += x;
    second += x * x;
    third += x * x * x;
    fourth += x * x * x * x;
  }
  const double error = 4 / std::sqrt(kDraws);
  EXPECT_NEAR(sum / kDraws, 0, error);
  EXPECT_NEAR(second / kDraws, 1, error * std::sqrt(2));
  EXPECT_NEAR(third / kDraws, 0, error * std::sqrt(15));
  EXPECT_NEAR(fourth / kDraws, 3, error * std::sqrt(96));
}

TEST(NormalNoise, FillsEachBinAsTheNormalDistributionDoes) {
  // From -4 to 4 in steps of a quarter, and the tails beyond: the edges of the layers and the tail
  // of the ziggurat lie within.
  constexpr int kBins = 34;
  std::array<int, kBins> counts{};
  const NormalNoise& noise = NormalNoise::instance();
  Rng streams(2);
  for (int i = 0; i < kDraws; ++i) {
    const double place = std::floor((noise.draw(Rng(streams.next())) + 4) * 4) + 1;
    ++counts.at(static_cast<std::size_t>(std::fmin(std::fmax(place, 0), kBins - 1)));
  }
  double chi2 = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double below = bin == 0 ? 0 : normal_cdf(-4 + 0.25 * (bin - 1));
    const double upto = bin == kBins - 1 ? 1 : normal_cdf(-4 + 0.25 * bin);
    const double expected = kDraws * (upto - below);
    const double off = counts.at(static_cast<std::size_t>(bin)) - expected;
    chi2 += off * off / expected;
  }
  EXPECT_LT(chi2, 63.9) << "the 99.9 % quantile with 33 degrees of freedom";
}

TEST(NormalNoise, IsAFunctionOfTheStream) {
  for (std::uint64_t stream = 0; stream < 1000; ++stream) {
    const double draw = NormalNoise::instance().draw(Rng(stream));
    EXPECT_EQ(NormalNoise::instance().draw(Rng(stream)), draw);
  }
}

}  // namespace
}  // namespace swarmsmith
