#include "sim/engine/internal/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/rng.h"

namespace swarmsmith {
namespace {

Body moving_body(Rng& rng) {
  Body body = body_at({rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-kPi, kPi)});
  body.vx = rng.uniform(-0.3, 0.3);
  body.vy = rng.uniform(-0.3, 0.3);
  body.spin = rng.uniform(-4.1, 4.1);
  return body;
}

/// A set-point as commands make it: some at rest, some met already.
SetPoint target(Rng& rng, const Body& body) {
  switch (rng.below(4)) {
    case 0:
      return {};
    case 1:
      return {body.vx, body.vy, body.spin};
    case 2:
      return {body.vx, body.vy, rng.uniform(-4.1, 4.1)};
    default:
      return {rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), rng.uniform(-4.1, 4.1)};
  }
}

double largest_difference(const Body& a, const Body& b) {
  return std::max({std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.cos - b.cos),
                   std::fabs(a.sin - b.sin), std::fabs(a.vx - b.vx), std::fabs(a.vy - b.vy),
                   std::fabs(a.spin - b.spin)});
}

TEST(Motion, ClosedFormEqualsTheSubSteps) {
  Rng rng(1);
  double worst = 0;
  for (int i = 0; i < 20'000; ++i) {
    Body stepped = moving_body(rng);
    const SetPoint set_point = target(rng, stepped);
    Body jumped = stepped;
    const int sub_steps = i % 2 == 0 ? 10 : static_cast<int>(1 + rng.below(20));
    for (int k = 0; k < sub_steps; ++k)
      sub_step(stepped, set_point);
    advance_freely(jumped, set_point, sub_steps);
    worst = std::max(worst, largest_difference(stepped, jumped));
  }
  EXPECT_LT(worst, 1e-12);
}

TEST(Motion, ClosedFormEqualsTheSubStepsWhenTheSetPointIsAWholeNumberOfStepsAway) {
  for (int steps = 0; steps <= 12; ++steps) {
    const SetPoint set_point = {steps * kSpeedStep_mps, 0, -steps * kSpinStep_radps};
    Body stepped;
    Body jumped;
    for (int k = 0; k < 10; ++k)
      sub_step(stepped, set_point);
    advance_freely(jumped, set_point, 10);
    EXPECT_LT(largest_difference(stepped, jumped), 1e-14) << steps;
  }
}

TEST(Motion, StoppingFromFullSpeedTakesFourTicksAndSixCentimetres) {
  Body body;
  body.vx = 0.3;
  for (int tick = 0; tick < 4; ++tick) {
    EXPECT_GT(body.vx, 0);
    advance_freely(body, {}, 10);
  }
  EXPECT_NEAR(body.vx, 0, 1e-15);
  EXPECT_NEAR(body.x, 0.06, 0.002);
}

TEST(Motion, ASpeedWhoseSquareIsZeroComesToTheSetPointToo) {
  for (const double speed : {1e-150, 1e-161, 3e-162, 1e-162, 1e-163, 1e-300, 5e-324}) {
    for (const int sub_steps : {1, 10}) {
      Body body = body_at({0.25, -1, 0});
      body.vx = speed;
      body.vy = -speed;
      advance_freely(body, {}, sub_steps);
      EXPECT_EQ(body, body_at({0.25, -1, 0})) << speed;
    }
  }
}

TEST(Motion, ATurnThatIsNoTurnEndsAndIsSeen) {
  for (const double angle : {1e300, -1e6, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    Body body;
    turn(body, angle);
    EXPECT_FALSE(is_sound(body)) << angle;
  }
  Body body;
  turn(body, kMostTurn_rad);
  EXPECT_NEAR(body.cos, std::cos(kMostTurn_rad), 1e-8);
}

TEST(Motion, ABodyIsSoundWhenAllOfItsNumbersAre) {
  EXPECT_TRUE(is_sound(body_at({1, -2, 3})));
  for (double Body::*const part :
       {&Body::x, &Body::y, &Body::cos, &Body::sin, &Body::vx, &Body::vy, &Body::spin}) {
    for (const double wrong : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e7, -1e7}) {
      Body body;
      body.*part = wrong;
      EXPECT_FALSE(is_sound(body)) << wrong;
    }
  }
}

TEST(Motion, TurnAgreesWithTheAngleAlsoBeyondARightOne) {
  for (const double angle : {0.0, 1e-9, -0.3, 0.5, 0.51, -1.6, 3.0, -9.4}) {
    Body body = body_at({0, 0, 0.7});
    turn(body, angle);
    EXPECT_NEAR(body.cos, std::cos(0.7 + angle), 1e-12) << angle;
    EXPECT_NEAR(body.sin, std::sin(0.7 + angle), 1e-12) << angle;
  }
}

TEST(Motion, HeadingStaysAUnitVector) {
  Rng rng(2);
  Body body;
  for (int i = 0; i < 100'000; ++i)
    turn(body, rng.uniform(-0.5, 0.5));
  EXPECT_NEAR(body.cos * body.cos + body.sin * body.sin, 1, 1e-15);
}

TEST(Motion, SetPointsPointAlongTheHeading) {
  const Body body = body_at({0, 0, kPi / 2});
  const SetPoint forward = set_point_of({0.3, 0.3}, body);
  EXPECT_NEAR(forward.vx, 0, 1e-16);
  EXPECT_DOUBLE_EQ(forward.vy, 0.3);
  EXPECT_EQ(forward.spin, 0);
  const SetPoint left = set_point_of({-0.3, 0.3}, body);
  EXPECT_EQ(left.vx, 0);
  EXPECT_NEAR(left.spin, 4.08, 0.002);
}

TEST(Motion, PosesSurviveTheWayThroughABody) {
  const Pose pose = {0.25, -1, -2.5};
  const Pose back = pose_of(body_at(pose));
  EXPECT_EQ(back.position(), pose.position());
  EXPECT_NEAR(back.theta, pose.theta, 1e-15);
}

}  // namespace
}  // namespace swarmsmith
