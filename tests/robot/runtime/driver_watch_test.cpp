#include "robot/runtime/driver_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/rng.h"
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
    if (of.clock == of.fault_at + milliseconds(300))
      of.node.driver().hear(RivalMessage{{of.clock - milliseconds(250), 0}, "/teleop"});
  });
  EXPECT_EQ(robot.state().phase, Phase::Ended);
  EXPECT_EQ(robot.state().verdict, RunVerdict::Degraded);
  EXPECT_THAT(robot.state().reasons,
              ElementsAre("driver: /teleop also commands the treads, for up to 0.25 s, at 5.0 s: "
                          "1 cycle was not stepped"));
  EXPECT_EQ(robot.node.head().end->driver, RunVerdict::Degraded);
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

using Names = std::vector<const char*>;

/// A watch whose times are milliseconds since the start of its run. "driver" listens, and reports
/// that the treads stand, shortly before the run.
class Watched {
 public:
  explicit Watched(DriverWatch::Limits limits = {}, bool reports = true) : watch(limits) {
    listen(-100, {"driver"});
    if (reports) say(-100, 0, 0);
  }

  TimePoint at(int ms) const { return start + milliseconds(ms); }
  void command(int ms, double left, double right) { watch.commanded(at(ms), left, right); }
  void say(int ms, double left, double right, const char* sender = "driver") {
    watch.hear(DrivenMessage{{at(ms), 0}, left, right, sender});
  }
  void rival(int ms, const char* sender = "/teleop") {
    watch.hear(RivalMessage{{at(ms), 0}, sender});
  }
  /// These are the listeners now, and all of them have just given a sign of life.
  void listen(int ms, const Names& names, bool drive = true) {
    std::vector<Listener> listeners;
    for (const char* name : names)
      listeners.push_back({name, at(ms), drive});
    watch.set_listeners(listeners, at(ms));
  }
  void begin() { watch.begin(start); }
  /// Straight on, as commanded and reported, in steps of 100 ms.
  void goes_straight(int from_ms, int to_ms) {
    command(from_ms, 0.3, 0.3);
    for (int ms = from_ms; ms < to_ms; ms += 100)
      say(ms, 0.3, 0.3);
    say(to_ms, 0.3, 0.3);
  }
  /// "ends since 100: why", or nothing.
  std::string trouble(int ms) {
    const auto found = watch.trouble(at(ms));
    if (!found) return "";
    EXPECT_TRUE(found->holds || !found->ends);
    return fmt::format("{} since {}: {}", found->ends ? "ends" : "holds",
                       (found->since - start) / milliseconds(1), found->what);
  }
  int longest_off_ms() const { return static_cast<int>(watch.longest_off() / milliseconds(1)); }

  TimePoint start{std::chrono::seconds(1000)};
  DriverWatch watch;
};

constexpr const char* kNoReport = "driver does not report what the treads do";

TEST(DriverWatch, ASilentDriverHoldsAfter300MillisecondsAndEndsTheRunAfterASecond) {
  Watched of;
  of.begin();
  of.goes_straight(0, 0);
  EXPECT_EQ(of.trouble(300), "");
  EXPECT_EQ(of.longest_off_ms(), 300) << "measured also when it is allowed";
  EXPECT_EQ(of.trouble(301), std::string("holds since 0: ") + kNoReport);
  EXPECT_EQ(of.trouble(1000), std::string("holds since 0: ") + kNoReport);
  EXPECT_EQ(of.trouble(1001), std::string("ends since 0: ") + kNoReport);
  EXPECT_EQ(of.longest_off_ms(), 1001);
  of.watch.end();
  EXPECT_EQ(of.trouble(2000), "") << "the run is over";
  Watched patient({.hold = milliseconds(0), .give_up = milliseconds(0)});
  patient.begin();
  EXPECT_EQ(patient.trouble(0), "");
  EXPECT_EQ(patient.trouble(1),
            "ends since 0: driver reports 0 and 0 m/s, and 0 and 0 m/s are "
            "commanded: it stopped them")
      << "nothing was commanded";
}

TEST(DriverWatch, AReportCountsFor250MillisecondsAsTheReason) {
  Watched of;
  of.begin();
  of.goes_straight(0, 0);
  of.say(100, 0.17, 0.11);
  EXPECT_EQ(of.trouble(350),
            "holds since 0: driver reports 0.17 and 0.11 m/s, and 0.3 and 0.3 m/s are commanded: "
            "it follows other commands");
  EXPECT_EQ(of.trouble(351), std::string("holds since 0: ") + kNoReport);
  of.say(400, 0.3, 0.3, "other");
  of.say(800, 0.3, 0.3, "other");
  EXPECT_EQ(of.trouble(1000), "holds since 400: other drives the treads in place of driver");
  EXPECT_EQ(of.trouble(1050), "ends since 0: other drives the treads in place of driver");
  EXPECT_EQ(of.trouble(1051), std::string("ends since 0: ") + kNoReport);
  of.listen(1052, {});
  EXPECT_EQ(of.trouble(1052),
            "ends since 0: driver has disconnected: no driver listens to the speeds of the treads");
}

TEST(DriverWatch, SaysWhatTheTreadsDoInPlaceOfTheCommand) {
  struct Case {
    double left;
    double right;
    const char* why;
  };
  // 0.3 and -0.3 m/s were commanded until the start, 0 and 0.2 m/s until 200 ms.
  for (const Case& of :
       {Case{0.3, 0.1, "only the left one obeys"}, Case{-0.1, 0.3, "only the right one obeys"},
        Case{0.31, 0.1, "only the left one obeys"}, Case{0.32, 0.1, "it follows other commands"},
        Case{0, 0, "it stopped them"}, Case{0, 0.2, "it is 0.40 s behind"},
        Case{0, 0.1, "it follows other commands"}, Case{0.3, -0.3, "it is 0.60 s behind"}}) {
    Watched watched;
    watched.command(-100, 0.3, -0.3);
    watched.begin();
    watched.command(0, 0, 0.2);
    watched.command(200, 0.3, 0.3);
    watched.say(600, of.left, of.right);
    EXPECT_EQ(watched.trouble(600),
              fmt::format("holds since 0: driver reports {} and {} m/s, and 0.3 and 0.3 m/s are "
                          "commanded: {}",
                          of.left, of.right, of.why));
  }
}

TEST(DriverWatch, TreadsThatStandMayBeLateOrStopped) {
  Watched of;
  of.command(-100, 0, 0);
  of.begin();
  of.command(100, 0.3, 0.3);
  of.say(900, 0, 0);
  const std::string what =
      " since 100: driver reports 0 and 0 m/s, and 0.3 and 0.3 m/s are "
      "commanded: ";
  EXPECT_EQ(of.trouble(900), "holds" + what + "it is 0.80 s behind, or stopped them");
  EXPECT_EQ(of.trouble(1100), "holds" + what + "it is 0.80 s behind, or stopped them");
  EXPECT_EQ(of.trouble(1101), "ends" + what + "it stopped them");
}

TEST(DriverWatch, NoReportIsOfALaterCommand) {
  Watched of;
  of.begin();
  of.command(0, 0.3, 0.3);
  of.command(500, 0.3, 0.2);
  of.say(499, 0.3, 0.2);
  EXPECT_EQ(of.trouble(500),
            "holds since 0: driver reports 0.3 and 0.2 m/s, and 0.3 and 0.2 m/s "
            "are commanded: only the left one obeys");
  of.say(499, 0.3, 0.3);
  EXPECT_EQ(of.trouble(749),
            "holds since 499: driver reports 0.3 and 0.3 m/s, and 0.3 and 0.2 m/s "
            "are commanded: it is 0.00 s behind")
      << "until it reports a stop";
}

TEST(DriverWatch, SpeedsDifferByMoreThanRounding) {
  const auto is_obeyed = [](double left, double right) {
    Watched of;
    of.begin();
    of.command(0, 0, 0);
    of.say(300, left, right);
    return of.trouble(301).empty();
  };
  EXPECT_TRUE(is_obeyed(0.011, -0.011));
  EXPECT_FALSE(is_obeyed(0.0111, 0));
  EXPECT_FALSE(is_obeyed(0, -0.0111));
}

TEST(DriverWatch, AReportIsLateAfter300Milliseconds) {
  for (const int ms : {600, 601}) {
    Watched watched;
    watched.begin();
    watched.goes_straight(0, 290);
    watched.command(300, 0.3, -0.3);
    watched.say(ms, 0.3, 0.3);
    EXPECT_EQ(watched.trouble(ms),
              ms == 600 ? ""
                        : "holds since 251: driver reports 0.3 and 0.3 m/s, and 0.3 and -0.3 m/s "
                          "are commanded: it is 0.30 s behind");
  }
  // One tread that stands does not make it a stop.
  for (const bool left : {false, true}) {
    Watched watched;
    watched.begin();
    watched.command(0, left ? 0.3 : 0, left ? 0 : 0.3);
    watched.goes_straight(100, 350);
    watched.say(600, left ? 0.3 : 0, left ? 0 : 0.3);
    EXPECT_EQ(watched.trouble(600),
              fmt::format("holds since 250: driver reports {} and {} m/s, and 0.3 and 0.3 m/s are "
                          "commanded: it is 0.50 s behind",
                          left ? 0.3 : 0, left ? 0 : 0.3));
    EXPECT_EQ(watched.longest_off_ms(), 350);
  }
  Watched stops;
  stops.begin();
  stops.command(0, 0, 0);
  stops.goes_straight(100, 350);
  stops.say(600, 0, 0);
  EXPECT_EQ(stops.trouble(600), "") << "standing treads do no harm";
}

TEST(DriverWatch, TreadsStayHeldUntilALaterReportThatTheyStand) {
  Watched of;
  of.begin();
  of.goes_straight(0, 0);
  const std::string late = "driver reports 0.3 and 0.3 m/s, and 0 and 0 m/s are commanded: it is ";
  EXPECT_EQ(of.trouble(400), std::string("holds since 0: ") + kNoReport);
  of.command(400, 0, 0);
  of.say(400, 0, 0);  // it may have stopped for another reason
  EXPECT_EQ(of.trouble(440),
            "holds since 400: driver reports 0 and 0 m/s, and 0 and 0 m/s are "
            "commanded: it is 0.00 s behind, or stopped them");
  of.say(450, 0.3, 0.3);
  EXPECT_EQ(of.trouble(450), "holds since 400: " + late + "0.05 s behind");
  of.say(500, 0, 0);
  EXPECT_EQ(of.trouble(500), "");
  of.goes_straight(600, 650);
  EXPECT_EQ(of.trouble(660), "");
  EXPECT_EQ(of.trouble(1000), std::string("holds since 650: ") + kNoReport);
  of.command(1000, 0, 0);
  of.say(1050, 0.3, 0.3);
  EXPECT_EQ(of.trouble(1050), "holds since 1000: " + late + "0.05 s behind") << "as the first time";
  of.say(1060, 0, 0);
  EXPECT_EQ(of.trouble(1060), "");
  EXPECT_EQ(of.longest_off_ms(), 400);
}

TEST(DriverWatch, ThreeStrangeReportsInSuccessionEndTheRun) {
  const std::string strange =
      "driver reports 0.17 and 0 m/s, and 0.3 and 0.3 m/s are commanded: "
      "it follows other commands";
  Watched of;
  of.begin();
  of.command(0, 0.3, 0.3);
  for (int ms = 310; ms < 330; ms += 10)
    of.say(ms, 0.17, 0);
  EXPECT_EQ(of.trouble(320), "holds since 0: " + strange);
  of.say(330, 0, 0);  // a driver may always stop
  of.say(340, 0.17, 0);
  of.say(350, 0.17, 0);
  EXPECT_EQ(of.trouble(350), "holds since 0: " + strange);
  of.rival(355);
  EXPECT_EQ(of.trouble(355), "holds since 355: /teleop also commands the treads");
  of.say(360, 0.17, 0);
  EXPECT_EQ(of.trouble(360), "ends since 0: " + strange) << "before what only holds";
  EXPECT_EQ(of.longest_off_ms(), 360);
  of.watch.end();
  of.start += std::chrono::seconds(1);
  of.begin();
  of.command(0, 0.3, 0.3);
  of.say(310, 0.17, 0);
  EXPECT_EQ(of.trouble(310), "holds since 0: " + strange) << "another run";
}

TEST(DriverWatch, SpellsWithoutObedienceAreAddedUpIfTheyAreThreeSecondsApartAtMost) {
  for (const int later : {0, 1}) {
    Watched of;
    of.begin();
    of.goes_straight(0, 0);
    EXPECT_EQ(of.trouble(500), std::string("holds since 0: ") + kNoReport);
    EXPECT_EQ(of.trouble(800), std::string("holds since 0: ") + kNoReport);
    of.command(800, 0, 0);
    of.say(900, 0, 0);
    EXPECT_EQ(of.trouble(900), "");
    of.goes_straight(1000, 3499 + later);
    EXPECT_EQ(of.trouble(3799 + later), "");
    EXPECT_EQ(
        of.trouble(3800 + later),
        fmt::format("{} since {}: {}", later == 0 ? "ends" : "holds", 3499 + later, kNoReport));
  }
  Watched of;
  of.begin();
  for (int piece = 0; piece < 2; ++piece) {
    of.goes_straight(1000 * piece, 1000 * piece);
    EXPECT_EQ(of.trouble(1000 * piece + 301),
              fmt::format("holds since {}: {}", 1000 * piece, kNoReport));
    EXPECT_EQ(of.trouble(1000 * piece + 500),
              fmt::format("holds since {}: {}", 1000 * piece, kNoReport));
    of.command(1000 * piece + 500, 0, 0);
    of.say(1000 * piece + 501, 0, 0);
    EXPECT_EQ(of.trouble(1000 * piece + 501), "");
  }
  // Two pieces of 0.5 s, and then the first moment of a third one.
  of.goes_straight(2000, 2000);
  EXPECT_EQ(of.trouble(2301), std::string("ends since 2000: ") + kNoReport);
}

TEST(DriverWatch, AnotherSenderHoldsForAMomentAndEndsTheRunAfterASecond) {
  const auto watched = [](int ms) {
    Watched of;
    of.begin();
    of.goes_straight(0, ms);
    return of;
  };
  const std::string why = "/teleop also commands the treads";
  Watched of = watched(600);
  of.rival(100);
  EXPECT_EQ(of.trouble(100), "holds since 100: " + why);
  EXPECT_EQ(of.trouble(400), "holds since 100: " + why);
  EXPECT_EQ(of.trouble(401), "");
  EXPECT_EQ(of.longest_off_ms(), 300);
  of.rival(500, "/other");
  EXPECT_EQ(of.trouble(600), "holds since 500: /other also commands the treads");
  EXPECT_EQ(of.longest_off_ms(), 300);
  for (const int later : {0, 1}) {
    of = watched(1100);
    of.rival(100);
    of.rival(1100 + later);
    EXPECT_EQ(of.trouble(1101), (later == 0 ? "holds since 100: " : "ends since 100: ") + why);
    EXPECT_EQ(of.longest_off_ms(), 1001);
    of = watched(3100);
    of.rival(100);
    of.rival(3100 + later);
    EXPECT_EQ(of.trouble(3101), (later == 0 ? "ends since 100: " : "holds since 3101: ") + why);
    of = watched(4200);
    of.rival(100);
    of.rival(1200);
    EXPECT_EQ(of.trouble(4200 + later), later == 0 ? "ends since 100: " + why : "");
  }
  of = watched(300);
  of.say(200, 0.3, 0.3, "other");
  EXPECT_EQ(of.trouble(300), "holds since 200: other also drives the treads, besides driver");
}

TEST(DriverWatch, CommandsAreRememberedForTenSeconds) {
  for (const int later : {0, 1}) {
    Watched of;
    of.begin();
    of.command(0, 0.3, -0.3);
    of.command(100, 0.3, 0.3);
    for (int ms = 100; ms <= 9700; ms += 200)
      of.say(ms, 0.3, 0.3);
    of.command(10100 + later, 0.3, 0.2);
    of.say(10102, 0.3, -0.3);
    EXPECT_EQ(of.trouble(10102),
              fmt::format("holds since 9700: driver reports 0.3 and -0.3 m/s, and 0.3 and 0.2 m/s "
                          "are commanded: {}",
                          later == 0 ? "it is 10.00 s behind" : "only the left one obeys"));
  }
}

/// For each 200 ms, "turn" is commanded for the second half; "straight" is all that the driver
/// reports, except in these rounds.
/// With `silent` it then reports nothing.
std::vector<std::string> troubles_of_ignored_turns(int rounds, const std::vector<int>& obeyed,
                                                   bool silent = false) {
  Watched of;
  of.say(-40, 0.3, 0.3);
  of.begin();
  std::vector<std::string> troubles;
  for (int round = 0; round < rounds; ++round) {
    const int ms = 200 * round;
    of.command(ms, 0.3, -0.3);
    // Repeated, as in each cycle: it is one command.
    of.command(ms + 50, 0.3, -0.3);
    const bool turns = std::ranges::find(obeyed, round) != obeyed.end();
    of.say(ms + 90, 0.3, turns ? -0.3 : 0.3);
    of.command(ms + 100, 0.3, 0.3);
    of.say(ms + 110, 0.3, 0.3);
  }
  // A turn is over if it ended more than 300 ms ago.
  const int last = 200 * (rounds - 1) + 100;
  of.command(last + 100, 0.3, -0.3);
  if (!silent) of.say(last + 300, 0.3, 0.3);
  for (const int ms : {last + 300, silent ? last + 311 : last + 301})
    troubles.push_back(of.trouble(ms));
  return troubles;
}

TEST(DriverWatch, ACommandIsIgnoredIfTheDriverMissesItForASecondInAll) {
  const std::string why = "driver ignored the command 0.3 and -0.3 m/s, which was given ";
  EXPECT_THAT(troubles_of_ignored_turns(10, {}), ElementsAre("", ""));
  EXPECT_THAT(troubles_of_ignored_turns(11, {}),
              ElementsAre("", "holds since 0: " + why + "11 times, for 1.1 s in all"));
  EXPECT_THAT(troubles_of_ignored_turns(20, {}),
              ElementsAre("", "holds since 0: " + why + "20 times, for 2.0 s in all"));
  EXPECT_THAT(troubles_of_ignored_turns(21, {}),
              ElementsAre("", "ends since 0: " + why + "21 times, for 2.1 s in all"));
  EXPECT_THAT(troubles_of_ignored_turns(20, {}, true),
              ElementsAre("", std::string("holds since 3910: ") + kNoReport));
  EXPECT_THAT(troubles_of_ignored_turns(21, {}, true),
              ElementsAre("", "ends since 0: " + why + "21 times, for 2.1 s in all"));
  // What it has obeyed once, it can do: only what came after this counts.
  EXPECT_THAT(troubles_of_ignored_turns(16, {5}), ElementsAre("", ""));
  EXPECT_THAT(troubles_of_ignored_turns(17, {5}),
              ElementsAre("", "holds since 1110: " + why + "11 times, for 1.1 s in all"));
  EXPECT_THAT(troubles_of_ignored_turns(17, {5, 16}), ElementsAre("", ""));
}

TEST(DriverWatch, ACommandIsObeyedIfItsSpeedsAreReportedWithin300MillisecondsOfIt) {
  // A turn of 100 ms, twelve times; each first report of it comes so long after its end.
  const auto trouble = [](int after_ms) {
    Watched of;
    of.begin();
    for (int round = 0; round < 12; ++round) {
      const int ms = 750 * round;
      of.goes_straight(ms + 100, ms + 190);
      of.command(ms + 300, 0.3, -0.3);
      if (after_ms < 0) of.say(ms + 400 + after_ms, 0.3, -0.3);
      of.goes_straight(ms + 400, ms + 410);
      of.goes_straight(ms + 411, ms + 699);
      if (after_ms >= 0) of.say(ms + 400 + after_ms, 0.3, -0.3);
      of.say(ms + 702, 0.3, 0.3);
    }
    return of.trouble(11 * 750 + 702);
  };
  EXPECT_EQ(trouble(-100), "") << "at the instant of the command";
  EXPECT_EQ(trouble(300), "");
  EXPECT_THAT(trouble(301), HasSubstr("which was given 12 times"));
}

/// A random pattern of two speeds, each commanded at most three times in succession:
/// each report agrees with one of the last four commands. It comes again each `period` cycles,
/// except in a part of them.
std::vector<bool> pattern(Rng& rng, int cycles, int period, double changed) {
  std::vector<bool> turns;
  for (int k = 0; k < cycles; ++k) {
    bool turn = k < period || rng.bernoulli(changed) ? rng.bernoulli(0.5)
                                                     : turns[static_cast<std::size_t>(k - period)];
    if (k >= 3 &&
        turns[static_cast<std::size_t>(k - 1)] == turns[static_cast<std::size_t>(k - 2)] &&
        turns[static_cast<std::size_t>(k - 2)] == turns[static_cast<std::size_t>(k - 3)])
      turn = !turns[static_cast<std::size_t>(k - 1)];
    turns.push_back(turn);
  }
  return turns;
}

/// The verdict on a driver that reports a speed in each cycle of 100 ms, and the number of its
/// changes at that time.
struct Judged {
  std::string end;
  std::vector<std::string> doubts;
  int changes = 0;
};

/// From the shares of all changes that match the command of each delay in whole cycles. Changes
/// before the last 25 (or 120) fade.
Judged expected_of(const std::vector<bool>& wanted, const std::vector<bool>& said) {
  struct Rule {
    int least;
    int most;
    double better;
    std::vector<double> share = std::vector<double>(31);
  };
  std::vector<Rule> rules{{12, 25, 0.2}, {60, 120, 0.08}};
  constexpr std::ptrdiff_t kLate = 4;  // in cycles, as 300 ms are allowed
  Judged judged;
  double prompt = 1;
  for (std::size_t k = 1; k < said.size(); ++k) {
    if (said[k] == said[k - 1]) continue;
    ++judged.changes;
    for (Rule& rule : rules) {
      for (std::size_t delay = 0; delay < rule.share.size(); ++delay) {
        const double match = wanted[k - std::min(k, delay)] == said[k] ? 1 : 0;
        rule.share[delay] += (match - rule.share[delay]) / std::min(judged.changes, rule.most);
      }
      const auto late = rule.share.begin() + kLate;
      const auto best = std::max_element(late, rule.share.end());
      const double allowed = *std::max_element(rule.share.begin(), late);
      if (rule.most == 25) prompt = allowed;
      if (judged.changes < rule.least || *best < 0.9 || *best - allowed < rule.better) continue;
      judged.end =
          fmt::format("ends since {}: driver makes each change {:.2f} s after its command", 100 * k,
                      0.1 * static_cast<double>(best - rule.share.begin()) - 0.05);
      return judged;
    }
  }
  if (judged.changes >= 25 && prompt < 0.6)
    judged.doubts = {"driver reports changes of speed that do not follow the commands"};
  return judged;
}

Judged judged(const std::vector<bool>& wanted, const std::vector<bool>& said) {
  Watched of;
  const auto right = [](bool turns) { return turns ? -0.3 : 0.3; };
  of.say(-10, 0.3, right(said[0]));
  of.begin();
  Judged judged;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const int ms = 100 * static_cast<int>(k);
    of.command(ms, 0.3, right(wanted[k]));
    of.say(ms, 0.3, right(said[k]));
    if (const std::string trouble = of.trouble(ms + 40); !trouble.empty()) {
      judged.end = trouble;
      return judged;
    }
  }
  judged.doubts = of.watch.doubts();
  return judged;
}

TEST(DriverWatch, ALateDriverIsFoundByItsChangesAndAnUnsteadyOneDoubted) {
  Rng rng(1);
  int soon = 0;
  int later = 0;
  int doubted = 0;
  int trusted = 0;
  for (int tried = 0; tried < 300; ++tried) {
    const int period = static_cast<int>(rng.uniform_int(4, 9));
    const int cycles = static_cast<int>(rng.uniform_int(20, 300));
    const auto wanted = pattern(rng, cycles, period, rng.uniform(0, 0.5));
    std::vector<bool> said = wanted;
    if (tried % 5 == 0) {
      said = pattern(rng, cycles, cycles, 0);
    } else {
      const auto delay = static_cast<std::size_t>(tried % 5 == 1   ? rng.uniform_int(0, 3)
                                                  : tried % 5 == 2 ? rng.uniform_int(4, 5)
                                                                   : period);
      for (std::size_t k = 0; k < said.size(); ++k)
        said[k] = wanted[k - std::min(k, delay)];
    }
    const Judged expected = expected_of(wanted, said);
    const Judged found = judged(wanted, said);
    EXPECT_EQ(found.end, expected.end) << tried;
    EXPECT_EQ(found.doubts, expected.doubts) << tried;
    ++(!expected.doubts.empty()     ? doubted
       : expected.end.empty()       ? trusted
       : expected.changes > 25 + 30 ? later
                                    : soon);
  }
  EXPECT_GT(std::min({soon, later, doubted, trusted}), 10);
}

TEST(DriverWatch, WithoutReportsSignsOfLifeDecide) {
  const auto silent = [] { return Watched({}, false); };
  const std::string none = "since 0: no driver listens to the speeds of the treads";
  Watched of = silent();
  of.listen(-500, {});
  of.begin();
  EXPECT_EQ(of.trouble(300), "") << "treads need not obey before the start";
  EXPECT_EQ(of.trouble(301), "holds " + none);
  EXPECT_EQ(of.trouble(1000), "holds " + none);
  EXPECT_EQ(of.trouble(1001), "ends " + none);
  EXPECT_EQ(of.longest_off_ms(), 1001);
  of = silent();
  of.begin();
  of.listen(400, {"driver"});
  of.listen(500, {});
  EXPECT_EQ(of.trouble(700), "");
  EXPECT_EQ(of.trouble(701), "holds since 400: no driver listens to the speeds of the treads");
  EXPECT_EQ(of.longest_off_ms(), 301);

  of = silent();
  of.listen(-10, {"driver", "recorder"});
  of.begin();
  of.listen(400, {"driver"});
  of.listen(500, {"other", "third"});
  EXPECT_EQ(of.trouble(700), "");
  EXPECT_EQ(of.trouble(701), "holds since 400: the driver was replaced by other, third");
  EXPECT_EQ(of.trouble(1401), "ends since 400: the driver was replaced by other, third");
  of = silent();
  of.listen(0, {});
  of.begin();
  of.listen(500, {"other"});
  of.listen(900, {"other"});
  EXPECT_EQ(of.trouble(1300), "") << "it replaces none";

  // Of two listeners one does not respond: it counts if it says that it drives.
  for (const bool drives : {false, true}) {
    of = silent();
    const auto listen = [&of, drives](int ms, int driver_ms, int recorder_ms) {
      of.watch.set_listeners({{"driver", of.at(driver_ms), drives},
                              {"recorder", of.at(recorder_ms), false},
                              {"old", of.at(-1001), drives}},
                             of.at(ms));
    };
    listen(0, 0, -1000);
    of.begin();
    listen(990, 0, 980);
    EXPECT_EQ(of.trouble(1000), "");
    EXPECT_EQ(of.trouble(1001), drives ? "ends since 0: driver does not respond" : "");
    listen(1500, 0, 970);  // a message overtook another
    EXPECT_EQ(of.trouble(1981), drives ? "ends since 0: driver does not respond"
                                       : "ends since 980: driver, recorder do not respond");
    listen(1981, 981, 970);
    EXPECT_EQ(of.trouble(1981), "");
  }
  of = silent();
  of.watch.set_listeners({{"old", of.at(-1001), true}}, of.at(0));
  of.begin();
  EXPECT_EQ(of.trouble(5000), "") << "it never gave a sign of life";
}

TEST(DriverWatch, DoubtsARunInWhichListenersChanged) {
  Watched of({}, false);
  of.listen(-50, {"driver", "recorder"});
  of.listen(-20, {"recorder", "driver", "early"});
  of.listen(-10, {"driver", "recorder"});
  of.begin();
  const std::string none =
      "no driver reports what the treads do (`driven`): if it stops obeying, nothing shows it";
  EXPECT_THAT(of.watch.doubts(), ElementsAre(none));
  of.listen(10, {"driver", "late"});
  of.listen(20, {"driver"});
  of.listen(30, {"late", "driver", "recorder"});
  of.listen(40, {"late", "driver"});
  of.listen(50, {"mute"}, false);
  const std::vector<std::string> doubts{
      none, "recorder listened to the speeds of the treads, but disconnected during the run",
      "driver listened to the speeds of the treads, but disconnected during the run",
      "late connected during the run and says that it drives"};
  EXPECT_EQ(of.watch.doubts(), doubts);
  of.watch.end();
  of.listen(60, {"after"});
  EXPECT_EQ(of.watch.doubts(), doubts) << "the run is over";
  Watched told;
  told.begin();
  told.listen(10, {"driver", "late"});
  told.listen(20, {});
  EXPECT_THAT(told.watch.doubts(), ElementsAre(doubts.back()));
}

/// All that is said of a run in which one thing after the other goes wrong. `driver` is the name of
/// the driver.
std::vector<std::string> story(const DriverWatch& watch, TimePoint start, const char* driver,
                               bool reports) {
  Watched of;
  of.watch = watch;
  of.start = start;
  std::vector<std::string> said;
  const auto note = [&](int ms) { said.push_back(of.trouble(ms)); };
  of.listen(-100, {driver});
  if (reports) of.say(-100, 0, 0, driver);
  of.begin();
  note(0);
  for (int ms = 0; ms < 1200; ms += 50) {
    const double right = ms % 100 == 0 ? 0.3 : -0.3;
    of.command(ms, 0.3, right);
    if (reports) of.say(ms, 0.3, right, driver);
    of.listen(ms, {driver});
    note(ms);
  }
  said.push_back(std::to_string(of.longest_off_ms()));
  for (int ms = 1201; reports && ms < 1203; ++ms)
    of.say(ms, 0.17, 0.1, driver);
  for (int ms = 1300; ms <= 1600; ms += 50)
    note(ms);
  if (reports) of.say(1600, 0.17, 0.1, "another");
  of.rival(1600);
  note(1600);
  of.listen(1700, {"another"});
  note(1750);
  of.listen(1800, {});
  note(2300);
  for (const std::string& doubt : of.watch.doubts())
    said.push_back(doubt);
  said.push_back(std::to_string(of.longest_off_ms()));
  return said;
}

TEST(DriverWatch, JudgesASecondRunAsTheFirst) {
  // The first run has all kinds of trouble, shortly before the second one.
  Watched of;
  of.start -= milliseconds(20000);
  of.listen(-100, {"driver", "recorder"});
  of.begin();
  for (int k = 0; k < 190; ++k) {
    of.command(100 * k, k / 5 % 2 == 0 ? 0.4 : -0.4, 0.4);
    of.say(100 * k, (k - 8) / 5 % 2 == 0 ? 0.4 : -0.4, 0.4);
    of.trouble(100 * k);
  }
  for (int ms = 19000; ms < 19900; ms += 100) {
    of.say(ms, 0.17, 0.11);
    of.say(ms, 0.17, 0.11, "other");
    of.rival(ms);
    of.trouble(ms);
  }
  of.listen(19890, {"driver", "late"});
  EXPECT_EQ(of.trouble(19899).substr(0, 4), "ends");
  EXPECT_THAT(of.watch.doubts(), Not(IsEmpty()));
  of.watch.end();
  const TimePoint start = of.start + milliseconds(20000);
  const DriverWatch fresh({});
  EXPECT_EQ(story(of.watch, start, "driver", true), story(fresh, start, "driver", true));
  EXPECT_EQ(story(of.watch, start, "mute", false), story(fresh, start, "mute", false));
}

TEST(DriverWatch, IsReadyIfOneDriverReportsAndDrivesAlone) {
  const auto not_ready = [](const Watched& of, int ms) { return of.watch.not_ready(of.at(ms)); };
  Watched of;
  of.say(0, 0, 0);
  EXPECT_THAT(not_ready(of, 1000), IsEmpty());
  EXPECT_THAT(not_ready(of, 1001),
              ElementsAre("driver: driver has not reported what the treads do for 1.0 s"));
  of.listen(1100, {"other"});
  EXPECT_THAT(not_ready(of, 1100), IsEmpty()) << "the present one has not reported yet";
  of.listen(1100, {});
  EXPECT_THAT(not_ready(of, 1100),
              ElementsAre("driver: no driver listens to the speeds of the treads"));
  of.listen(1100, {"driver", "other"});
  of.say(1100, 0, 0);
  of.say(1200, 0, 0, "other");
  of.rival(1150);
  const std::string both = "driver: driver and other both say that they drive the treads";
  const std::string rival = "driver: /teleop also commands the treads";
  EXPECT_THAT(not_ready(of, 2100), ElementsAre(both, rival));
  EXPECT_THAT(not_ready(of, 2101), ElementsAre(rival));
  EXPECT_THAT(not_ready(of, 2150), ElementsAre(rival));
  EXPECT_THAT(not_ready(of, 2151), IsEmpty());
  for (const int later : {0, 1}) {
    Watched patient({.hold = milliseconds(300), .give_up = std::chrono::seconds(10)});
    patient.listen(0, {"driver", "other"});
    patient.say(0, 0, 0);
    patient.say(3000 + later, 0, 0, "other");
    if (later == 0) {
      EXPECT_THAT(not_ready(patient, 3001), ElementsAre(both)) << "in turn within 3 s";
    } else {
      EXPECT_THAT(not_ready(patient, 3001), IsEmpty());
    }
  }
}

}  // namespace
}  // namespace swarmsmith
