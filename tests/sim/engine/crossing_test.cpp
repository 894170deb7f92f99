#include "sim/engine/internal/crossing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"

namespace swarmsmith {
namespace {

const Form kBox = form_of(BoxOutline{2, 1}, 0.5);
const Form kDisc = form_of(CircleOutline{0.5}, 0.5);
const Body kOrigin = body_at({0, 0, 0});

TEST(Crossing, OfABoxIsBetweenItsFaces) {
  const Stretch across = stretch_in(kBox, kOrigin, {-3, 0.25}, {1, 0});
  EXPECT_DOUBLE_EQ(across.from, 2);
  EXPECT_DOUBLE_EQ(across.to, 4);
  const Stretch half_as_long = stretch_in(kBox, kOrigin, {-3, 0.25}, {2, 0});
  EXPECT_DOUBLE_EQ(half_as_long.from, 1);
  EXPECT_TRUE(stretch_in(kBox, kOrigin, {-3, 0.75}, {1, 0}).empty());
}

TEST(Crossing, IsClosed) {
  EXPECT_FALSE(stretch_in(kBox, kOrigin, {-3, 0.5}, {1, 0}).empty()) << "along a face";
  EXPECT_TRUE(stretch_in(kBox, kOrigin, {-3, 0.50001}, {1, 0}).empty());
  const Stretch corner = stretch_in(kBox, kOrigin, {0, 1.5}, {1, -1});
  ASSERT_FALSE(corner.empty());
  EXPECT_DOUBLE_EQ(corner.from, 1);
  EXPECT_DOUBLE_EQ(corner.to, 1);
  EXPECT_FALSE(stretch_in(kDisc, kOrigin, {-3, 0.5}, {1, 0}).empty()) << "tangent";
  EXPECT_TRUE(stretch_in(kDisc, kOrigin, {-3, 0.50001}, {1, 0}).empty());
}

TEST(Crossing, IsInTheSolidsPlace) {
  // The box stands upright at (1, 1).
  const Stretch across = stretch_in(kBox, body_at({1, 1, kPi / 2}), {0, 1.9}, {1, 0});
  EXPECT_NEAR(across.from, 0.5, 1e-12);
  EXPECT_NEAR(across.to, 1.5, 1e-12);
}

TEST(Crossing, OfADiscIsAChord) {
  const Stretch chord = stretch_in(kDisc, body_at({1, 0, 0}), {0, 0.3}, {1, 0});
  EXPECT_NEAR(chord.from, 0.6, 1e-15);
  EXPECT_NEAR(chord.to, 1.4, 1e-15);
}

TEST(Crossing, OfALineWithoutLengthIsAllOrNothing) {
  EXPECT_FALSE(stretch_in(kBox, kOrigin, {1, 0.5}, {0, 0}).empty());
  EXPECT_TRUE(stretch_in(kBox, kOrigin, {1.1, 0.5}, {0, 0}).empty());
  EXPECT_FALSE(stretch_in(kDisc, kOrigin, {0.5, 0}, {0, 0}).empty());
  EXPECT_TRUE(stretch_in(kDisc, kOrigin, {0.4, 0.4}, {0, 0}).empty());
}

}  // namespace
}  // namespace swarmsmith
