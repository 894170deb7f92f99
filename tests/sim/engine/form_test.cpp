#include "sim/engine/internal/form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "sim/engine/internal/gaps.h"
#include "sim/engine/internal/mover.h"

namespace swarmsmith {
namespace {

TEST(Forms, ACirclesMeansAreTwoThirdsOfTheRadiusAndHalfItsSquare) {
  const Form form = form_of(CircleOutline{0.3}, 0.1);
  EXPECT_DOUBLE_EQ(form.mean_radius_m, 0.2);
  EXPECT_DOUBLE_EQ(form.mean_radius2_m2, 0.045);
}

TEST(Forms, ABoxsMeansAreThoseOfTheTextbook) {
  const Form form = form_of(BoxOutline{0.4, 0.2}, 0.1);
  EXPECT_NEAR(form.mean_radius2_m2, (0.16 + 0.04) / 12, 1e-15);
  // A square of side 1: (sqrt 2 + ln(1 + sqrt 2)) / 6.
  EXPECT_NEAR(form_of(BoxOutline{1, 1}, 0.1).mean_radius_m, 0.3825978582321475, 1e-12);
}

TEST(Forms, APolygonsMeansAreThoseOfManyPoints) {
  const Form form = form_of(PolygonOutline{{{0.2, 0}, {-0.1, 0.1}, {-0.1, -0.1}}}, 0.1);
  double count = 0;
  double sum = 0;
  double squares = 0;
  for (double x = -0.1 + 0.0005; x < 0.2; x += 0.001) {
    for (double y = -0.1 + 0.0005; y < 0.1; y += 0.001) {
      if (std::fabs(y) > (0.2 - x) / 3) continue;
      count += 1;
      sum += hypot(x, y);
      squares += x * x + y * y;
    }
  }
  EXPECT_NEAR(form.mean_radius_m, sum / count, 1e-4);
  EXPECT_NEAR(form.mean_radius2_m2, squares / count, 1e-4);
  EXPECT_DOUBLE_EQ(form.radius_m, 0.2);
  EXPECT_NEAR(form.normals[1].x, -1, 1e-15);
}

TEST(Forms, ABoxIsTheRvrsWhenBothSidesAre) {
  EXPECT_TRUE(form_of(BoxOutline{kBodySide_m, kBodySide_m}, 0.1).is_rvr);
  EXPECT_FALSE(form_of(BoxOutline{kBodySide_m, 0.2}, 0.1).is_rvr);
  EXPECT_FALSE(form_of(BoxOutline{0.2, kBodySide_m}, 0.1).is_rvr);
}

TEST(Movers, TheRvrKeepsItsNumbersAndOtherOutlinesItsMassAndDrive) {
  EXPECT_EQ(robot_kind(rvr()), rvr_kind());
  EXPECT_EQ(rvr_kind().dynamics, Dynamics{});
  const Dynamics round = robot_kind(rvr_with(CircleOutline{0.1})).dynamics;
  EXPECT_EQ(round.mass_kg, kMass_kg);
  EXPECT_DOUBLE_EQ(round.inertia_kg_m2, 0.01);
  EXPECT_EQ(round.speed_step_mps, kSpeedStep_mps);
  EXPECT_DOUBLE_EQ(round.spin_step_radps, 1.5 / 0.01 * 0.01);
}

TEST(Movers, AnObjectIsHeldByItsFriction) {
  const Dynamics disc =
      object_kind({.outline = CircleOutline{0.3}, .start = {}, .mass_kg = 2, .friction_N = 5})
          .dynamics;
  EXPECT_DOUBLE_EQ(disc.inertia_kg_m2, 0.09);
  EXPECT_DOUBLE_EQ(disc.speed_step_mps, 5.0 / 2 * 0.01);
  EXPECT_DOUBLE_EQ(disc.max_torque_Nm, 5 * 0.2);
  EXPECT_DOUBLE_EQ(disc.spin_step_radps, 1.0 / 0.09 * 0.01);
}

/// Points along a form's outline, in the world.
std::vector<Point> outline_points(const Form& form, const Body& at) {
  std::vector<Point> points;
  const auto add = [&](double x, double y) {
    points.push_back({at.x + at.cos * x - at.sin * y, at.y + at.sin * x + at.cos * y});
  };
  for (std::size_t i = 0; i < form.corners.size(); ++i) {
    const Point from = form.corners[i];
    const Point to = form.corners[(i + 1) % form.corners.size()];
    for (double t = 0; t < 1; t += 0.02)
      add(from.x + t * (to.x - from.x), from.y + t * (to.y - from.y));
  }
  for (int i = 0; form.is_circle() && i < 200; ++i)
    add(form.radius_m * cos(i * kPi / 100), form.radius_m * sin(i * kPi / 100));
  return points;
}

TEST(Gaps, AreNeverWiderThanTheDistanceAndTheSameFromBothSides) {
  Rng rng(4);
  const std::vector<Form> forms = {
      form_of(CircleOutline{0.1}, 0.1), form_of(BoxOutline{0.3, 0.1}, 0.1), rvr_form(),
      form_of(PolygonOutline{{{0.2, 0}, {-0.1, 0.1}, {-0.1, -0.1}}}, 0.1)};
  for (int i = 0; i < 200; ++i) {
    const Form& a = forms[rng.below(4)];
    const Form& b = forms[rng.below(4)];
    const Body at = body_at({0, 0, rng.uniform(-kPi, kPi)});
    const Body other = body_at({rng.uniform(0.2, 0.6), 0, rng.uniform(-kPi, kPi)});
    const WallPlane wall = {
        .nx = 1, .ny = 0, .offset_m = 0.4, .from = {0.4, 0.05}, .length_m = 0.2};
    double nearest = 10;
    double nearest_wall = 10;
    for (const Point& p : outline_points(a, at)) {
      for (const Point& q : outline_points(b, other))
        nearest = std::min(nearest, hypot(p.x - q.x, p.y - q.y));
      nearest_wall = std::min(nearest_wall, hypot(p.x - 0.4, p.y - std::clamp(p.y, 0.05, 0.25)));
    }
    EXPECT_LE(gap_between(a, at, b, other), nearest + 1e-9);
    EXPECT_LE(gap_to(a, at, wall), nearest_wall + 1e-9);
    EXPECT_NEAR(gap_between(a, at, b, other), gap_between(b, other, a, at), 1e-12);
  }
}

TEST(Gaps, BetweenFacesAreTheRoomBetweenThem) {
  const Form box = form_of(BoxOutline{0.4, 0.2}, 0.1);
  const Form disc = form_of(CircleOutline{0.1}, 0.1);
  const Body origin;
  EXPECT_NEAR(gap_between(box, origin, disc, body_at({0.35, 0.05, 1})), 0.05, 1e-15);
  EXPECT_NEAR(gap_between(box, origin, rvr_form(), body_at({0, 0.25, 0})), 0.007, 1e-15);
  EXPECT_NEAR(gap_between(disc, origin, disc, body_at({0.3, 0.4, 0})), 0.3, 1e-15);
  const WallPlane wall = {.nx = 1, .ny = 0, .offset_m = 0.5, .from = {0.5, -1}, .length_m = 0.8};
  EXPECT_NEAR(gap_to(box, body_at({0, -0.6, 0}), wall), 0.3, 1e-15);
  // Past the end of the face, in y from -1 to -0.2.
  EXPECT_NEAR(gap_to(box, body_at({0.5, 0.3, 0}), wall), 0.4, 1e-15);
  EXPECT_NEAR(gap_to(disc, body_at({0.8, 0.2, 0}), wall), 0.4, 1e-15);
}

}  // namespace
}  // namespace swarmsmith
