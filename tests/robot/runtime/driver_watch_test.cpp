#include "robot/runtime/driver_watch.h"

#include <gmock/gmock.h>

#include <functional>

#include "tests/robot/runtime/bench_robot.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A run of 30 s of a robot that turns now and then, whose driver is played by a function from
/// 5 s on: it gets what was commanded, newest last, and says what it likes.
class DrivenRobot : public BenchRobot {
 public:
  using Driver = std::function<void(DrivenRobot&)>;

  DrivenRobot() { obeys = false; }

  void say(double left, double right, const char* sender = "driver") {
    node.driver().hear(DrivenMessage{{clock, 0}, left, right, sender});
  }
  /// What was commanded so many cycles ago.
  const Command& commanded(std::size_t ago) const {
    return commands[commands.size() - std::min(commands.size(), ago + 1)];
  }

  /// One cycle; a wall comes and goes, so that it turns.
  void drive(const Driver& driver) {
    clock += milliseconds(100);
    send_ground();
    send_neighbours();
    send_ranges(++driven_ / 7 % 2 == 0 ? 0.1 : std::numeric_limits<double>::infinity());
    node.driver().set_listeners(listeners(), clock);
    node.hear(order(Order::Kind::Alive), now());
    driver(*this);
    tick();
    commands.push_back(treads);
    if (speed() > 0) last_moved = clock;
  }

  /// A whole run; the driver's fault begins after 5 s.
  void run_with(
      const Driver& fault, const Driver& before = [](DrivenRobot& robot) {
        robot.say(robot.treads.left_mps, robot.treads.right_mps);
      }) {
    for (int i = 0; i < 3; ++i)
      drive(before);
    node.hear(order(Order::Kind::Start), now());
    for (int i = 0; i < 60; ++i)
      drive(before);
    ASSERT_EQ(state().phase, Phase::Running) << testing::PrintToString(state().reasons);
    fault_at = clock;
    for (int i = 0; i < 250; ++i)
      drive(fault);
  }

  std::function<std::vector<Listener>()> listeners = [this] {
    return std::vector<Listener>{{"driver", clock, false}};
  };
  std::vector<Command> commands{1};
  TimePoint fault_at;
  TimePoint last_moved;

 private:
  int driven_ = 0;
};

/// The run is INVALID for this reason, and no tread was commanded to turn half a second after the
/// fault began.
void expect_invalid(const DrivenRobot& robot, const char* why, bool stops_at_once = true) {
  EXPECT_EQ(robot.state().phase, Phase::Failed) << why;
  EXPECT_EQ(robot.state().verdict, RunVerdict::Invalid);
  const auto& reasons = robot.state().reasons;
  ASSERT_FALSE(reasons.empty());
  EXPECT_THAT(reasons[0], HasSubstr(why));
  EXPECT_THAT(reasons[0], HasSubstr("since "));
  EXPECT_THAT(robot.rows.back().event, HasSubstr(why));
  EXPECT_EQ(robot.node.head().end->reasons, reasons);
  if (stops_at_once) {
    EXPECT_LE(robot.last_moved - robot.fault_at, milliseconds(500)) << why;
  }
}

TEST(DriverWatch, ADriverThatObeysIsValidAndMayTakeTwoCycles) {
  for (const std::size_t behind : {0U, 1U, 2U}) {
    DrivenRobot robot;
    const auto driver = [behind](DrivenRobot& of) {
      of.say(of.commanded(behind).left_mps, of.commanded(behind).right_mps);
    };
    robot.run_with(driver, driver);
    EXPECT_EQ(robot.state().phase, Phase::Ended);
    EXPECT_EQ(robot.state().verdict, RunVerdict::Valid)
        << behind << testing::PrintToString(robot.state().reasons);
  }
}

TEST(DriverWatch, ADriverMayRoundToACentimetreASecond) {
  DrivenRobot robot;
  const auto driver = [](DrivenRobot& of) {
    of.say(std::round(100 * of.treads.left_mps) / 100, std::round(100 * of.treads.right_mps) / 100);
  };
  robot.run_with(driver, driver);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Valid);
}

TEST(DriverWatch, ASilentDriverEndsTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot&) {});
  expect_invalid(robot, "driver: driver does not say what the treads do (for 1.10 s, since 5.0 s)");
}

TEST(DriverWatch, ADeadDriverEndsTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) { of.listeners = [] { return std::vector<Listener>(); }; });
  expect_invalid(robot, "driver is gone: no driver listens to the speeds of the treads");
}

TEST(DriverWatch, AReplacedDriverEndsTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) { of.say(of.treads.left_mps, of.treads.right_mps, "other"); });
  expect_invalid(robot, "other drives the treads in place of driver");
}

TEST(DriverWatch, ASecondDriverEndsTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) {
    of.say(of.treads.left_mps, of.treads.right_mps);
    of.say(of.treads.left_mps, of.treads.right_mps, "other");
  });
  expect_invalid(robot, "other drives the treads, too, beside driver");
}

TEST(DriverWatch, SpeedsOfAnotherOneEndTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) {
    of.say(of.treads.left_mps, of.treads.right_mps);
    of.node.driver().hear(RivalMessage{{of.clock, 0}, "/teleop"});
  });
  expect_invalid(robot, "/teleop commands the treads, too");
}

TEST(DriverWatch, OneSpeedOfAnotherOneDegradesTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) {
    of.say(of.treads.left_mps, of.treads.right_mps);
    if (of.clock == of.fault_at + milliseconds(100))
      of.node.driver().hear(RivalMessage{{of.clock, 0}, "/teleop"});
  });
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Degraded);
  EXPECT_THAT(robot.state().reasons[0], HasSubstr("driver: /teleop commands the treads, too"));
}

TEST(DriverWatch, ADriverThatObeysAnotherOneEndsTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) { of.say(0.17, 0.11); });
  expect_invalid(robot, "it obeys another one");
}

TEST(DriverWatch, ADriverThatHoldsTheTreadsEndsTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) {
    if (of.speed() == 0) return of.say(0, 0);
    of.say(0, 0);
  });
  // While the node holds them, too, they agree for a moment; it tries a few times.
  expect_invalid(robot, "driver says that they do 0 and 0 m/s, and 0.3", false);
}

TEST(DriverWatch, ADriverOfOneTreadEndsTheRun) {
  for (const bool left : {false, true}) {
    DrivenRobot robot;
    robot.run_with([left](DrivenRobot& of) {
      of.say(left ? of.treads.left_mps : 0, left ? 0 : of.treads.right_mps);
    });
    expect_invalid(robot, left ? "only the left one obeys" : "only the right one obeys");
  }
}

TEST(DriverWatch, ADriverThatStopsForAMomentDegradesTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) {
    const bool stops = of.clock - of.fault_at < milliseconds(500);
    of.say(stops ? 0 : of.treads.left_mps, stops ? 0 : of.treads.right_mps);
  });
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Degraded);
  EXPECT_THAT(robot.state().reasons[0], HasSubstr("it holds them"));
}

TEST(DriverWatch, ASlowDriverEndsTheRun) {
  for (const std::size_t behind : {5U, 8U, 15U}) {
    DrivenRobot robot;
    robot.run_with([behind](DrivenRobot& of) {
      of.say(of.commanded(behind).left_mps, of.commanded(behind).right_mps);
    });
    expect_invalid(robot, "s behind", false);
  }
}

TEST(DriverWatch, ASlowDriverIsFoundWhereSpeedsComeAgain) {
  for (const std::size_t behind : {8U, 10U}) {
    int cycle = 0;
    const auto of_time = [&cycle](std::size_t ago) {  // straight on, then left and straight in turn
      const int k = cycle - static_cast<int>(ago);
      return k % 17 < 9 || k % 2 == 0 ? Command{0.3, 0.3, {}} : Command{0.3, -0.3, {}};
    };
    DriverWatch watch({});
    TimePoint clock{std::chrono::seconds(100)};
    watch.set_listeners({{"driver", clock}}, clock);
    watch.begin(clock);
    std::optional<DriverWatch::Trouble> trouble;
    int prompt_cycles = 0;
    for (; cycle < 300 && !(trouble && trouble->ends); ++cycle) {
      const Command now = of_time(0);
      const bool is_late = cycle >= 150;
      watch.commanded(clock, now.left_mps, now.right_mps);
      const Command then = of_time(is_late ? behind : 1);
      clock += milliseconds(60);
      watch.hear(DrivenMessage{{clock, 0}, then.left_mps, then.right_mps, "driver"});
      clock += milliseconds(40);
      trouble = watch.trouble(clock);
      if (!is_late) {
        EXPECT_FALSE(trouble) << trouble->what;
        ++prompt_cycles;
      }
    }
    EXPECT_EQ(prompt_cycles, 150);
    ASSERT_TRUE(trouble && trouble->ends) << behind;
    EXPECT_THAT(trouble->what, HasSubstr("s after its command")) << behind;
  }
}

TEST(DriverWatch, WithoutADriverThatSaysWhatItDoesNoRunIsValid) {
  const auto nothing = [](DrivenRobot&) {};
  DrivenRobot robot;
  robot.run_with(nothing, nothing);
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Degraded);
  EXPECT_THAT(robot.state().reasons, ElementsAre(HasSubstr("no driver says what the treads do")));

  DrivenRobot dead;
  dead.run_with([](DrivenRobot& of) { of.listeners = [] { return std::vector<Listener>(); }; },
                nothing);
  expect_invalid(dead, "no driver listens to the speeds of the treads");
  DrivenRobot hung;
  hung.run_with(
      [](DrivenRobot& of) {
        of.listeners = [at = of.fault_at] { return std::vector<Listener>{{"driver", at, false}}; };
      },
      nothing);
  expect_invalid(hung, "driver gives no sign of life", false);
  DrivenRobot replaced;
  replaced.run_with(
      [](DrivenRobot& of) {
        of.listeners = [&of] { return std::vector<Listener>{{"other", of.clock, false}}; };
      },
      nothing);
  expect_invalid(replaced, "another one came in place of the driver: other");
}

TEST(DriverWatch, SaysBeforeARunWhatIsWrong) {
  const TimePoint now{std::chrono::seconds(100)};
  DriverWatch watch({});
  EXPECT_THAT(watch.not_ready(now), ElementsAre(HasSubstr("no driver listens")));
  watch.set_listeners({{"driver", now}}, now);
  EXPECT_THAT(watch.not_ready(now), IsEmpty()) << "one that says nothing may drive";
  watch.hear(DrivenMessage{{now, 0}, 0, 0, "driver"});
  EXPECT_THAT(watch.not_ready(now), IsEmpty());
  EXPECT_THAT(watch.not_ready(now + milliseconds(1500)),
              ElementsAre("driver: driver has not said what the treads do for 1.5 s"));
  watch.hear(DrivenMessage{{now, 0}, 0, 0, "other"});
  EXPECT_THAT(watch.not_ready(now), ElementsAre(HasSubstr("both say that they drive")));
  watch.hear(RivalMessage{{now, 0}, "/teleop"});
  EXPECT_THAT(watch.not_ready(now),
              ElementsAre(HasSubstr("both"), HasSubstr("/teleop commands the treads, too")));
}

}  // namespace
}  // namespace swarmsmith
