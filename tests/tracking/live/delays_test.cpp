#include "tracking/live/delays.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>

namespace swarmsmith {
namespace {

TEST(LiveDelays, TellQuantilesToHalfAPerMille) {
  LiveDelays delays;
  EXPECT_EQ(delays.quantile_s(0.5), 0);
  for (int i = 1000; i >= 1; --i)
    delays.add(0.001 * i);
  EXPECT_NEAR(delays.quantile_s(0.5), 0.5, 0.0005);
  EXPECT_NEAR(delays.quantile_s(0.95), 0.95, 0.0005);
  EXPECT_NEAR(delays.quantile_s(1), 1, 0.0005);
  EXPECT_NEAR(delays.latest_most_s(), 0.1, 1e-12);
  delays.add(3600);
  EXPECT_NEAR(delays.quantile_s(1), 3600, 1.8);
  delays.add(0);
  EXPECT_LT(delays.quantile_s(0), 1e-5);
}

/// A month of a camera with 30 pictures a second is 78 million of them.
TEST(LiveDelays, TakeNoMoreMemoryTheLongerACameraFilms) {
  LiveDelays delays;
  const auto film = [&](int pictures) {
    for (int i = 0; i < pictures; ++i)
      delays.add(0.02 + 0.01 * std::sin(0.001 * i));
  };
  const auto bytes = [] {
    const struct mallinfo2 info = ::mallinfo2();
    return info.uordblks + info.hblkhd;  // large pieces are mapped
  };
  film(10'000);
  const std::size_t before = bytes();
  film(1'000'000);
  EXPECT_LT(bytes(), before + 100'000);
}

}  // namespace
}  // namespace swarmsmith
