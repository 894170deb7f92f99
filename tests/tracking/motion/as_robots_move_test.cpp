#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "base/rng.h"
#include "tests/support/checks.h"
#include "tests/tracking/motion/seen_run.h"
#include "tracking/motion/internal/travel.h"
#include "tracking/motion/resampling.h"
#include "tracking/motion/track_run.h"

namespace swarmsmith {
namespace {

constexpr double kDegree = kPi / 180;

/// Paths of robots that drive, stop and turn as machines make them: straight on, a turn on the
/// spot, an arc. Kept at 1 ms, so that what is between them is nothing.
class Driven {
 public:
  struct Push {
    int robot = 0;
    double from_s = 0;
    double to_s = 0;
    double aside_m_s = 0;
    double ahead_m_s = 0;
  };
  struct Style {
    double speed_m_s = 0.3;
    double slip = 0;     ///< share of the speed that treads lose, changing each second
    double creep = 0;    ///< of the way, to the side: uneven ground
    bool spins = false;  ///< turns on the spot half of the time
    bool backwards = false;
    bool bends = false;    ///< turns while it drives, to the left
    double grip_m_s2 = 0;  ///< how fast a body takes its treads' speed; 0: at once
  };

  Driven(const Style& style, std::vector<Push> pushes, double seconds = 62) : seconds_(seconds) {
    const std::array<Pose, 3> starts{{{-0.55, -0.35, 0.3}, {0.55, -0.35, 2}, {0, 0.6, 4}}};
    for (int robot = 0; robot < 3; ++robot)
      drive(robot, starts.at(static_cast<std::size_t>(robot)), style, pushes);
  }

  Pose operator()(int robot, double time_s) const {
    const std::vector<Pose>& path = paths_.at(static_cast<std::size_t>(robot));
    const double at = std::clamp((time_s + 1) / kStep_s, 0.0, static_cast<double>(path.size() - 1));
    return path[static_cast<std::size_t>(std::llround(at))];
  }

 private:
  static constexpr double kStep_s = 0.001;
  /// Robots keep to a circle of their own, so that they touch nothing.
  static constexpr double kHome_m = 0.28;

  void drive(int robot, Pose pose, const Style& style, const std::vector<Push>& pushes) {
    Rng rng = Rng(7).split("drive/" + std::to_string(robot));
    const Point home = pose.position();
    std::vector<Pose>& path = paths_.at(static_cast<std::size_t>(robot));
    double until = 0;
    double speed = 0;
    double turn = 0;
    double lost = 0;
    Point moving;
    for (double time = -1; time < seconds_; time += kStep_s) {
      const bool is_pushed = std::ranges::any_of(pushes, [&](const Push& push) {
        return push.robot == robot && time >= push.from_s && time < push.to_s;
      });
      if (time >= until) {
        until = time + 0.4 + 1.2 * rng.uniform();
        const double choice = rng.uniform();
        const bool turns = choice < (style.spins ? 0.6 : 0.35);
        speed = turns ? 0 : style.speed_m_s;
        turn = turns          ? (rng.uniform() < 0.5 ? 2.2 : -2.2)
               : choice > 0.8 ? 1.5 * (rng.uniform() - 0.5)
                              : 0;
        if (style.bends) {
          speed = style.speed_m_s;
          turn = choice < 0.6 ? 2.2 : 0;
        }
        lost = style.slip * rng.uniform();
      }
      const double away = std::hypot(pose.x - home.x, pose.y - home.y);
      const double homewards = wrap_angle(std::atan2(home.y - pose.y, home.x - pose.x) -
                                          pose.theta - (style.backwards ? kPi : 0));
      double v = speed * (1 - lost);
      double w = turn;
      if (away > kHome_m && std::fabs(homewards) > 0.5 && speed > 0) {
        v = 0;
        w = homewards > 0 ? 2.2 : -2.2;
      }
      if (style.backwards) v = -v;
      double aside = style.creep * v;
      if (is_pushed) {
        for (const Push& push : pushes) {
          if (push.robot != robot || time < push.from_s || time >= push.to_s) continue;
          v = push.ahead_m_s;
          aside = push.aside_m_s;
          w = 0;
        }
      }
      const double c = std::cos(pose.theta);
      const double s = std::sin(pose.theta);
      const Point wanted{c * v - s * aside, s * v + c * aside};
      const double change = std::hypot(wanted.x - moving.x, wanted.y - moving.y);
      const double share =
          style.grip_m_s2 > 0 ? std::min(1.0, style.grip_m_s2 * kStep_s / (change + 1e-12)) : 1;
      moving.x += share * (wanted.x - moving.x);
      moving.y += share * (wanted.y - moving.y);
      pose.x += kStep_s * moving.x;
      pose.y += kStep_s * moving.y;
      pose.theta = wrap_angle(pose.theta + kStep_s * w);
      path.push_back(pose);
    }
  }

  double seconds_;
  std::array<std::vector<Pose>, 3> paths_;
};

Seeing usual() {
  return {.cycles = 600, .frame_rate = 15, .noise_px = 0.15};
}

/// Errors of the run, by their names.
std::vector<std::string> errors_of(const TrackedRun& run) {
  std::vector<std::string> names;
  for (const Issue& issue : run.issues) {
    if (is_error(issue.code)) names.push_back(std::string(name_of(issue.code)) + ": " + issue.text);
  }
  return names;
}

/// As if the tag of a robot had been put back turned, about its own middle.
void turn_tag(SeenRun& seen, int robot, double turned_rad) {
  RobotSetup& setup = seen.rig.robots.at(static_cast<std::size_t>(robot));
  OffsetCalibration& file = seen.rig.offsets.at(setup.offset_file);
  // The film has the tag as it is; the file says how it sat before.
  const double c = std::cos(turned_rad);
  const double s = std::sin(turned_rad);
  const TagOffset is = file.offset;
  file.offset = {c * is.x_m - s * is.y_m, s * is.x_m + c * is.y_m,
                 wrap_angle(is.yaw_rad - turned_rad)};
}

TEST(TravelTest, RobotsThatMoveAsRobotsDoAreNotBothered) {
  const std::array<Driven::Style, 6> styles{{{},
                                             {.speed_m_s = 0.03},
                                             {.slip = 0.5},
                                             {.creep = 0.05},
                                             {.spins = true},
                                             {.speed_m_s = 0.3, .slip = 0.2, .creep = 0.03}}};
  for (const Driven::Style& style : styles) {
    for (const double noise : {0.05, 0.3}) {
      Seeing seeing = usual();
      seeing.noise_px = noise;
      const TrackedRun run = seen_run(Driven(style, {}), seeing).track().value();
      for (const Issue& issue : run.issues)
        EXPECT_EQ(issue.code, IssueCode::Outliers) << style.speed_m_s << " " << issue.text;
      const Check* check = find_check(run, "way to the side", "rvr2");
      ASSERT_NE(check, nullptr);
      EXPECT_EQ(check->outcome, Check::Outcome::Passed);
      EXPECT_LT(*check->value, *check->limit);
    }
  }
}

/// On one and the same arc, a wrong heading looks like a wrong place of the tag: one cannot be
/// told from the other, and a turned tag is found all the same.
TEST(TravelTest, ARobotThatDrivesInCirclesIsNoExcuse) {
  for (const double turned : {0.0, 90.0, 180.0}) {
    SeenRun seen = seen_run(on_circle, usual());
    turn_tag(seen, 2, turned * kDegree);
    const TrackedRun run = seen.track().value();
    EXPECT_EQ(find_check(run, "travel against heading", "rvr1")->outcome, Check::Outcome::Passed);
    EXPECT_EQ(find_check(run, "tag against the treads", "rvr1")->outcome, Check::Outcome::NotRun);
    EXPECT_EQ(run.issues.empty(), turned == 0.0) << turned;
  }
}

TEST(TravelTest, ATagThatWasPutBackTurnedIsNamed) {
  for (const double turned : {90.0, -90.0, 30.0, 180.0}) {
    const Driven driven({}, {});
    SeenRun seen = seen_run(driven, usual());
    turn_tag(seen, 1, turned * kDegree);
    const TrackedRun run = seen.track().value();
    EXPECT_GT(worst_error(run, driven), 0.03);
    const Issue& issue = issue_of(run, IssueCode::TagTurned);
    EXPECT_EQ(issue.robot, "rvr2");
    EXPECT_THAT(issue.text, HasSubstr("its tag is turned by " +
                                      std::to_string(static_cast<int>(turned)) + " degrees since"));
    EXPECT_EQ(errors_of(run).size(), 1U) << errors_of(run).back();
    EXPECT_EQ(find_check(run, "travel against heading", "rvr2")->outcome, Check::Outcome::Failed);
    EXPECT_EQ(find_check(run, "travel against heading", "rvr1")->outcome, Check::Outcome::Passed);
  }
}

/// Its centre stays where it is: only its heading is another one.
TEST(TravelTest, ATagOverTheCentreMovesNothingWhenItIsTurned) {
  Seeing seeing = usual();
  seeing.offset = {0.001, -0.001, 0.2};
  SeenRun seen = seen_run(Driven({}, {}), seeing);
  turn_tag(seen, 0, 90 * kDegree);
  const TrackedRun run = seen.track().value();
  EXPECT_THAT(errors_of(run), IsEmpty());
  EXPECT_THAT(issue_of(run, IssueCode::HeadingOff).text, HasSubstr("positions are right"));
}

TEST(TravelTest, ARobotThatDrivesBackwardsIsNoTurnedTag) {
  const TrackedRun run = seen_run(Driven({.backwards = true}, {}), usual()).track().value();
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  // Where it turns about tells that from a turned tag, on which side so ever the tag sits.
  Seeing seeing = usual();
  seeing.offset = {0, 0.05, 0};
  const TrackedRun open = seen_run(Driven({.backwards = true}, {}), seeing).track().value();
  EXPECT_TRUE(open.issues.empty()) << open.issues.front().text;
}

/// Bodies skid after they turned. Robots that drive backwards do, too.
TEST(TravelTest, AFilmThatRunsBackwardsIsToldFromRobotsThatDo) {
  const Driven driven({.grip_m_s2 = 0.75}, {});
  const Truth reversed = [&](int robot, double time_s) { return driven(robot, 60 - time_s); };
  const TrackedRun run = seen_run(reversed, usual()).track().value();
  EXPECT_THAT(issue_of(run, IssueCode::Timestamps).text, HasSubstr("runs backwards"));
  const Driven backwards({.backwards = true, .grip_m_s2 = 0.75}, {});
  const TrackedRun right = seen_run(backwards, usual()).track().value();
  EXPECT_TRUE(right.issues.empty()) << right.issues.front().text;
}

TEST(TravelTest, ExchangedTagsAreNamedWithBothRobots) {
  const Driven driven({}, {});
  SeenRun seen = seen_run(driven, usual());
  // On rvr3 the tag sits otherwise. What the film shows is before the exchange; the files say what
  // it would have been, had it not been made.
  std::swap(seen.rig.offsets.at("rvr1.offset.toml").offset,
            seen.rig.offsets.at("rvr3.offset.toml").offset);
  seen.rig.offsets.at("rvr1.offset.toml").offset = {-0.05, 0.03, -1.2};
  Seeing other = usual();
  other.offset = {-0.05, 0.03, -1.2};
  const SeenRun third = seen_run(driven, other);
  for (std::size_t i = 0; i < seen.observations.sightings.size(); ++i) {
    if (seen.observations.sightings[i].tag == 3)
      seen.observations.sightings[i].corners = third.observations.sightings[i].corners;
  }
  const TrackedRun run = seen.track().value();
  EXPECT_EQ(std::ranges::count(run.issues, IssueCode::TagTurned, &Issue::code), 2);
  EXPECT_THAT(find_issue(run, IssueCode::TagTurned)->text, HasSubstr("their tags were exchanged"));
  EXPECT_THAT(find_issue(run, IssueCode::TagTurned)->text, HasSubstr("as rvr3 would"));
}

/// A body that turns while it drives goes on in its old direction, as if it turned about another
/// point. Its tag is right, and one that was moved is found all the same.
TEST(TravelTest, SkidsAreNoPlaceOfTheTag) {
  for (const double grip : {0.0, 0.75, 0.4}) {
    for (const double rate : {10.0, 30.0}) {
      for (const Point off : {Point{0, 0}, {0.03, 0}, {-0.03, 0}, {0, 0.03}}) {
        Seeing seeing = usual();
        seeing.frame_rate = rate;
        SeenRun seen = seen_run(Driven({.grip_m_s2 = grip}, {}), seeing);
        TagOffset& file = seen.rig.offsets.at("rvr1.offset.toml").offset;
        const double c = std::cos(file.yaw_rad);
        const double s = std::sin(file.yaw_rad);
        file.x_m += c * off.x + s * off.y;
        file.y_m += c * off.y - s * off.x;
        const TrackedRun run = seen.track().value();
        const Issue* issue = find_issue(run, IssueCode::TagPlaceDoubtful);
        const bool is_off = off.x != 0 || off.y != 0;
        const std::string what =
            fmt::format("grip {}, {} frames/s, {} {}", grip, rate, off.x, off.y);
        EXPECT_EQ(issue != nullptr, is_off) << what << " " << (issue ? issue->text : "");
        EXPECT_EQ(run.issues.empty(), !is_off) << what;
        EXPECT_THAT(errors_of(run), IsEmpty());
        const Check* check = find_check(run, "tag against the treads", "rvr1");
        ASSERT_TRUE(check->value) << what << " " << check->reason;
        EXPECT_NEAR(*check->value, is_off ? 30 : 0, 7) << what;
      }
    }
  }
}

TEST(TravelTest, ARobotThatWasPushedOrCarriedIsNamed) {
  const std::array<Driven::Push, 5> pushes{{{1, 20, 21, 0.2, 0},     // pushed for a second
                                            {1, 20, 20.4, 0.7, 0},   // shoved
                                            {1, 20, 26, -0.03, 0},   // slowly
                                            {1, 20, 22, 0.15, 0.1},  // across
                                            {1, 20, 20.6, 0.4, 0.4}}};
  for (const Driven::Push& push : pushes) {
    const TrackedRun run = seen_run(Driven({}, {push}), usual()).track().value();
    const Issue* issue = find_issue(run, IssueCode::Pushed);
    const bool is_proven = issue != nullptr;
    if (!is_proven) issue = find_issue(run, IssueCode::PushedDoubtful);
    ASSERT_NE(issue, nullptr) << push.aside_m_s;
    EXPECT_EQ(issue->robot, "rvr2");
    EXPECT_GT(*issue->to, 20);
    EXPECT_LT(*issue->from, push.to_s);
    EXPECT_EQ(errors_of(run).size(), is_proven ? 1U : 0U);
  }
}

TEST(TravelTest, ABumpOfAMomentIsNone) {
  const TrackedRun run =
      seen_run(Driven({}, {{1, 20, 20.1, 0.2, 0}, {2, 30, 30.2, -0.1, 0.1}}), usual())
          .track()
          .value();
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
}

/// Each bend adds a skid, and all go to the same side: they add up to more than a push moves.
TEST(TravelTest, SkidsAreNoPush) {
  for (const double grip : {0.75, 0.4}) {
    for (const double rate : {10.0, 15.0, 30.0}) {
      Seeing seeing = usual();
      seeing.frame_rate = rate;
      const Driven::Style style{.bends = true, .grip_m_s2 = grip};
      const TrackedRun run = seen_run(Driven(style, {}), seeing).track().value();
      EXPECT_EQ(find_issue(run, IssueCode::PushedDoubtful), nullptr) << grip << " " << rate;
      EXPECT_EQ(find_issue(run, IssueCode::Pushed), nullptr) << grip << " " << rate;
      if (grip < 0.5) continue;
      // Nor do they hide one.
      const Driven pushed(style, {{1, 20, 21, 0.25, 0}});
      const TrackedRun other = seen_run(pushed, seeing).track().value();
      const Issue* issue = find_issue(other, IssueCode::Pushed);
      if (issue == nullptr) issue = find_issue(other, IssueCode::PushedDoubtful);
      ASSERT_NE(issue, nullptr) << grip << " " << rate;
      EXPECT_EQ(issue->robot, "rvr2");
    }
  }
}

/// Robots push each other, and slide along walls, and are not carried.
TEST(TravelTest, WhatTouchesARobotMayPushIt) {
  const Truth touching = [](int robot, double time_s) {
    if (robot == 0) return Pose{-0.5 + 0.02 * time_s, 0, 0};
    if (robot == 1) return Pose{-0.2 + 0.02 * time_s, 0, 0.5 * kPi};  // pushed to its side
    return Pose{-0.3 + 0.018 * time_s, -1.05, 0.4 * kPi};             // along the wall
  };
  Seeing seeing = usual();
  seeing.cycles = 300;
  const TrackedRun run = seen_run(touching, seeing).track().value();
  EXPECT_TRUE(run.issues.empty()) << run.issues.front().text;
  EXPECT_EQ(find_check(run, "way to the side", "rvr2")->outcome, Check::Outcome::NotRun);
}

TEST(TravelFit, WantsTwentyFreeStepsForAHeading) {
  std::vector<TravelStep> steps;
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(fit_travel(steps).knows_heading) << i;
    steps.push_back({.from_s = 0.1 * i, .to_s = 0.1 * (i + 1), .ahead_m = 0.03, .aside_m = -0.003});
  }
  const TravelFit fit = fit_travel(steps);
  EXPECT_TRUE(fit.knows_heading);
  EXPECT_NEAR(fit.turned_rad, std::atan(0.1), 1e-6);
  steps.back().touches = true;
  EXPECT_FALSE(fit_travel(steps).knows_heading);
}

TEST(TravelFit, WantsTurnsForADistanceByTurn) {
  for (const double turn_rad : {0.001, 0.3}) {
    std::vector<TravelStep> steps;
    for (int i = 0; i < 40; ++i) {
      const double turn = i % 2 == 0 ? turn_rad : -turn_rad;
      steps.push_back(
          {.from_s = 0.1 * i, .to_s = 0.1 * (i + 1), .ahead_m = 0.03, .turn_rad = turn});
    }
    const TravelFit fit = fit_travel(steps);
    EXPECT_TRUE(fit.knows_heading) << turn_rad;
    EXPECT_EQ(fit.knows_by_turn, turn_rad > 0.1);
  }
}

}  // namespace
}  // namespace swarmsmith
