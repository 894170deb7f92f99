#include "robot/runtime/driver_watch.h"

#include <functional>
#include <utility>
#include <vector>

#include "tests/robot/runtime/bench_robot.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using testing::AnyOf;

/// A run of 30 s of a robot that turns now and then, whose driver is played by a function from
/// 5 s on: it gets what was commanded, newest last, and says what it likes.
class DrivenRobot : public BenchRobot {
 public:
  using Driver = std::function<void(DrivenRobot&)>;

  DrivenRobot() { obeys = false; }

  void say(double left, double right, const char* sender = "driver") {
    node.driver().hear(DrivenMessage{{clock, 0}, left, right, sender});
  }
  void obey(const char* sender = "driver") { say(treads.left_mps, treads.right_mps, sender); }
  void hear_rival() { node.driver().hear(RivalMessage{{clock, 0}, "/teleop"}); }
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
      const Driver& fault, const Driver& before = [](DrivenRobot& robot) { robot.obey(); }) {
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

TEST(DriverWatch, TheLogSaysForHowLongTheDriverDidNotObey) {
  using testing::Field;
  const auto is = [](bool driven, RunVerdict driver, double least_s, double most_s) {
    return AllOf(Field(&RunEnd::driven, driven), Field(&RunEnd::driver, driver),
                 Field(&RunEnd::driver_off_s, testing::Ge(least_s)),
                 Field(&RunEnd::driver_off_s, testing::Le(most_s)));
  };
  DrivenRobot prompt;
  prompt.run_with([](DrivenRobot& of) { of.obey(); });
  EXPECT_THAT(prompt.node.head().end.value(), is(true, RunVerdict::Valid, 0, 0.1));
  DrivenRobot pauses;
  pauses.run_with([](DrivenRobot& of) {
    if (of.clock - of.fault_at > milliseconds(600)) of.obey();
  });
  EXPECT_THAT(pauses.node.head().end.value(), is(true, RunVerdict::Degraded, 0.5, 0.7));
  DrivenRobot silent;
  silent.run_with([](DrivenRobot&) {});
  EXPECT_THAT(silent.node.head().end.value(), is(true, RunVerdict::Invalid, 1.0, 1.2));
  DrivenRobot contradicted;
  contradicted.run_with([](DrivenRobot& of) {
    of.obey();
    of.hear_rival();
  });
  EXPECT_THAT(contradicted.node.head().end.value(), is(true, RunVerdict::Invalid, 1.0, 1.2));
  DrivenRobot quiet;
  const auto nothing = [](DrivenRobot&) {};
  quiet.run_with(nothing, nothing);
  EXPECT_THAT(quiet.node.head().end.value(), is(false, RunVerdict::Valid, 0, 0));
}

TEST(DriverWatch, ADriverMayRoundToACentimetreASecond) {
  DrivenRobot robot;
  const auto driver = [](DrivenRobot& of) {
    of.say(std::round(100 * of.treads.left_mps) / 100, std::round(100 * of.treads.right_mps) / 100);
  };
  robot.run_with(driver, driver);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Valid);
}

TEST(DriverWatch, ADriverThatFailsEndsTheRun) {
  const std::vector<std::pair<const char*, DrivenRobot::Driver>> faults{
      {"driver: driver does not report what the treads do (for 1.10 s, since 5.0 s)",
       [](DrivenRobot&) {}},
      {"driver has disconnected: no driver listens to the speeds of the treads",
       [](DrivenRobot& of) { of.listeners = [] { return std::vector<Listener>(); }; }},
      {"other drives the treads in place of driver", [](DrivenRobot& of) { of.obey("other"); }},
      {"other also drives the treads, besides driver",
       [](DrivenRobot& of) {
         of.obey();
         of.obey("other");
       }},
      {"/teleop also commands the treads",
       [](DrivenRobot& of) {
         of.obey();
         of.hear_rival();
       }},
      {"it follows other commands", [](DrivenRobot& of) { of.say(0.17, 0.11); }}};
  for (const auto& [why, fault] : faults) {
    DrivenRobot robot;
    robot.run_with(fault);
    expect_invalid(robot, why);
  }
}

TEST(DriverWatch, OneSpeedOfAnotherOneDegradesTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) {
    of.obey();
    if (of.clock == of.fault_at + milliseconds(100)) of.hear_rival();
  });
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Degraded);
  EXPECT_THAT(robot.state().reasons[0], HasSubstr("driver: /teleop also commands the treads"));
}

TEST(DriverWatch, ADriverThatHoldsTheTreadsEndsTheRun) {
  DrivenRobot robot;
  robot.run_with([](DrivenRobot& of) { of.say(0, 0); });
  // While the node holds them, too, they agree for a moment; it tries a few times.
  expect_invalid(robot, "driver reports 0 and 0 m/s, and 0.3", false);
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
  EXPECT_THAT(robot.state().reasons[0], HasSubstr("it stopped them"));
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

/// A driver alone, without a node: what is commanded in a cycle, and what the driver says then.
struct Played {
  std::optional<DriverWatch::Trouble> trouble;  ///< the first that ends the run
  int cycle = 0;                                ///< when
  int held = 0;                                 ///< when the treads are first to stand
};

const Command kStraight{0.3, 0.3, {}};
const Command kTurns{0.3, -0.3, {}};

/// 1200 cycles; the fault begins with the 300th.
Played play(const std::function<Command(int)>& wanted,
            const std::function<Command(int)>& says_then) {
  DriverWatch watch({});
  TimePoint clock{std::chrono::seconds(100)};
  watch.set_listeners({{"driver", clock}}, clock);
  watch.begin(clock);
  Played played{.trouble = {}, .cycle = 1200, .held = 1200};
  for (int cycle = 0; cycle < 1200; ++cycle) {
    watch.commanded(clock, wanted(cycle).left_mps, wanted(cycle).right_mps);
    const Command said = cycle < 300 ? wanted(cycle - 1) : says_then(cycle);
    clock += milliseconds(60);
    watch.hear(DrivenMessage{{clock, 0}, said.left_mps, said.right_mps, "driver"});
    clock += milliseconds(40);
    const auto trouble = watch.trouble(clock);
    if (trouble && trouble->holds) played.held = std::min(played.held, cycle);
    if (!trouble || !trouble->ends) continue;
    played.trouble = trouble;
    played.cycle = cycle;
    break;
  }
  return played;
}

/// Turns of one to three cycles that come again each `period` cycles, but now and then do not.
Command often_turning(int cycle, int period) {
  const int round = cycle / period;
  const bool is_odd_one = round % 4 == 0;
  const bool turns = cycle % period < (is_odd_one ? 1 : period / 2);
  return turns ? kTurns : kStraight;
}

/// Straight on, then left and straight in turn.
Command alternating(int k) {
  return k % 17 < 9 || k % 2 == 0 ? kStraight : kTurns;
}

/// The first cycle of the fault in which such a driver does what was last commanded too long ago.
int first_late(int behind) {
  for (int k = 300;; ++k) {
    bool is_wanted = false;
    for (int ago = 0; ago <= 3; ++ago)
      is_wanted |= alternating(k - ago).right_mps == alternating(k - behind).right_mps;
    if (!is_wanted) return k;
  }
}

TEST(DriverWatch, TreadsStandWhenOneActIsLate) {
  for (const int behind : {5, 8, 10, 13}) {
    const Played played = play(alternating, [&](int k) { return alternating(k - behind); });
    const int late = first_late(behind);
    EXPECT_GE(played.held, 300) << behind;
    EXPECT_LE(played.held, late + 1) << behind;
    ASSERT_TRUE(played.trouble) << behind;
    EXPECT_LE(played.cycle, late + 40) << behind;
  }
}

TEST(DriverWatch, OneLateActDoesNotEndTheRun) {
  const int late = first_late(8);
  const Played played =
      play(alternating, [&](int k) { return alternating(k == late ? k - 8 : k - 1); });
  EXPECT_FALSE(played.trouble) << played.trouble->what;
  EXPECT_EQ(played.held, late);
}

TEST(DriverWatch, ASlowDriverIsFoundWhereSpeedsComeAgain) {
  for (const int behind : {8, 10}) {
    const auto& wanted = alternating;
    const Played played = play(wanted, [&](int k) { return wanted(k - behind); });
    ASSERT_TRUE(played.trouble) << behind;
    EXPECT_GE(played.cycle, 300) << played.trouble->what;
    EXPECT_THAT(played.trouble->what,
                AnyOf(HasSubstr("s after its command"), HasSubstr("s behind")))
        << behind;
  }
}

TEST(DriverWatch, ASlowDriverIsFoundWhereItIsLateByThePeriodOfThePattern) {
  for (const int period : {4, 5, 6}) {
    const auto wanted = [period](int k) { return often_turning(k, period); };
    const Played slow = play(wanted, [&](int k) { return wanted(k - 1 - period); });
    ASSERT_TRUE(slow.trouble) << period;
    EXPECT_GE(slow.cycle, 300) << slow.trouble->what;
    EXPECT_THAT(slow.trouble->what, HasSubstr("s after its command")) << period;
    const Played prompt = play(wanted, [&](int k) { return wanted(k - 1); });
    EXPECT_FALSE(prompt.trouble) << period << prompt.trouble->what;
  }
}

TEST(DriverWatch, ADriverThatDoesNotDoWhatIsCommandedForAMomentIsFound) {
  for (const int period : {2, 4}) {
    const auto wanted = [period](int k) { return k % period < period / 2 ? kStraight : kTurns; };
    const Played stuck = play(wanted, [](int) { return kStraight; });
    ASSERT_TRUE(stuck.trouble) << period;
    EXPECT_GE(stuck.cycle, 300) << stuck.trouble->what;
    EXPECT_LE(stuck.cycle, 360) << period;
    EXPECT_LE(stuck.held, 330) << period;
    EXPECT_THAT(stuck.trouble->what,
                HasSubstr("ignored the command 0.3 and -0.3 m/s, which was given "));
  }
}

TEST(DriverWatch, ADriverThatNeverMovesIsOffSinceTheStartAtMost) {
  DriverWatch watch({});
  const TimePoint start{std::chrono::hours(24)};
  TimePoint clock = start;
  watch.set_listeners({{"driver", clock}}, clock);
  watch.hear(DrivenMessage{{clock, 0}, 0, 0, "driver"});
  watch.begin(clock);
  bool is_troubled = false;
  for (int cycle = 0; cycle < 300; ++cycle) {
    const Command wanted = cycle % 4 == 0 ? kStraight : Command{};
    watch.commanded(clock, wanted.left_mps, wanted.right_mps);
    clock += milliseconds(60);
    watch.hear(DrivenMessage{{clock, 0}, 0, 0, "driver"});
    clock += milliseconds(40);
    is_troubled |= watch.trouble(clock).has_value();
  }
  EXPECT_TRUE(is_troubled);
  EXPECT_LE(watch.longest_off(), clock - start);
}

TEST(DriverWatch, ADriverThatStandsForAMomentEndsNoRunThoughNoStopWasCommanded) {
  const Played played =
      play([](int) { return kStraight; }, [](int k) { return k < 306 ? Command{} : kStraight; });
  EXPECT_FALSE(played.trouble) << played.trouble->what;
  EXPECT_LT(played.held, 306);
}

TEST(DriverWatch, ACommandOfMoreThanTenSecondsAgoIsNoOther) {
  // The last turn ended 10 s before the fault.
  const Played played =
      play([](int k) { return k < 200 ? kTurns : kStraight; }, [](int) { return kTurns; });
  ASSERT_TRUE(played.trouble);
  EXPECT_THAT(played.trouble->what, HasSubstr("obeys"));
  EXPECT_LT(played.cycle, 306);
}

TEST(DriverWatch, ADriverThatLooksFiveTimesASecondIsNoSlowOne) {
  // Each cycle another speed, as robots command that follow others.
  const auto wanted = [](int k) { return Command{0.3, 0.3 - 0.001 * (k * 7919 % 500), {}}; };
  const Played played = play(wanted, [&](int k) { return wanted(k / 2 * 2); });
  EXPECT_FALSE(played.trouble) << played.trouble->what;
}

TEST(DriverWatch, ADriverThatLooksFiveTimesASecondMayMissWhatIsCommandedForOneCycle) {
  for (int seed = 0; seed < 20; ++seed) {
    // A turn of one cycle now and then; half of them come between two looks.
    const auto wanted = [seed](int k) {
      return (k + 10 * seed) * 7919 % 11 < 3 ? kTurns : kStraight;
    };
    const Played played = play(wanted, [&](int k) { return wanted((k - seed % 2) / 2 * 2); });
    EXPECT_FALSE(played.trouble) << seed << played.trouble->what;
  }
}

TEST(DriverWatch, WithoutADriverThatSaysWhatItDoesNoRunIsValid) {
  const auto nothing = [](DrivenRobot&) {};
  DrivenRobot robot;
  robot.run_with(nothing, nothing);
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Degraded);
  EXPECT_THAT(robot.state().reasons,
              ElementsAre(HasSubstr("no driver reports what the treads do")));

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
  expect_invalid(hung, "driver does not respond", false);
  DrivenRobot replaced;
  replaced.run_with(
      [](DrivenRobot& of) {
        of.listeners = [&of] { return std::vector<Listener>{{"other", of.clock, false}}; };
      },
      nothing);
  expect_invalid(replaced, "the driver was replaced by other");
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
              ElementsAre("driver: driver has not reported what the treads do for 1.5 s"));
  watch.hear(DrivenMessage{{now, 0}, 0, 0, "other"});
  EXPECT_THAT(watch.not_ready(now), ElementsAre(HasSubstr("both say that they drive")));
  watch.hear(RivalMessage{{now, 0}, "/teleop"});
  EXPECT_THAT(watch.not_ready(now),
              ElementsAre(HasSubstr("both"), HasSubstr("/teleop also commands the treads")));
}

/// Changes are remembered for three seconds: with more patience than that, none of them is late.
TEST(DriverWatch, WithLongPatienceNoChangeIsLate) {
  DriverWatch watch({.hold = std::chrono::seconds(10), .give_up = std::chrono::seconds(10)});
  TimePoint at{std::chrono::seconds(100)};
  watch.set_listeners({{"driver", at, true}}, at);
  watch.begin(at);
  for (int i = 0; i < 200; ++i) {
    at += milliseconds(100);
    watch.commanded(at, i / 5 % 2 == 0 ? 0.1 : 0.3, 0.1);
    watch.hear(DrivenMessage{{at, 0}, (i - 10) / 5 % 2 == 0 ? 0.1 : 0.3, 0.1, "driver"});
    EXPECT_FALSE(watch.trouble(at)) << i;
  }
}

}  // namespace
}  // namespace swarmsmith
