#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "robot/transport/ends.h"
#include "robot/transport/messages.h"

namespace swarmsmith {

/// Checks during a run whether the treads execute the commands of this node. If the driver reports
/// its speeds (DrivenMessage), they are checked: the last instant at which the treads are known to
/// have obeyed must not be long ago. For a driver without reports, only its connection and its
/// signs of life are known. Pure.
class DriverWatch {
 public:
  struct Limits {
    Duration hold = std::chrono::milliseconds(300);  ///< after this time without obedience the
                                                     ///< treads must stand still
    Duration give_up = std::chrono::seconds(1);      ///< after this time the run is over
  };

  explicit DriverWatch(Limits limits);

  /// Records a command that was sent.
  void commanded(TimePoint at, double left_mps, double right_mps);
  void hear(const DrivenMessage& driven);
  void hear(const RivalMessage& rival);
  /// Sets the present receivers of commands.
  void set_listeners(std::vector<Listener> listeners, TimePoint now);

  /// Called when a run begins at this time, and when a run is over.
  void begin(TimePoint start);
  void end() { runs_ = false; }

  /// A present problem, with the time at which it began.
  struct Trouble {
    TimePoint since;
    bool holds = false;  ///< the treads must stand still
    bool ends = false;   ///< the run is over, too
    std::string what;    ///< "/driver says nothing"
  };
  /// Must be called in each cycle.
  std::optional<Trouble> trouble(TimePoint now);

  /// The reasons why a run cannot start; empty: it can.
  std::vector<std::string> not_ready(TimePoint now) const;
  /// Whether a driver has reported tread speeds.
  bool is_told() const { return !driver_.empty(); }
  /// The longest time of the run during which the treads were not known to obey, or another sender
  /// acted on them.
  Duration longest_off() const { return longest_off_; }
  /// The reasons why a run without an observed problem is still not VALID.
  std::vector<std::string> doubts() const;

 private:
  struct Commanded {
    TimePoint from;
    double left_mps = 0;
    double right_mps = 0;
    bool said = false;  ///< reported by the driver, at that time or shortly after
  };
  /// For delays in steps of 50 ms, the share of the driver's last changes that match the commands
  /// sent so long before; and by how much a late delay must match better than a prompt one.
  struct Follows {
    static constexpr std::size_t kDelays = 61;
    int least = 0;  ///< least number of changes for a decision
    int most = 0;   ///< number of changes that are remembered
    double better = 0;
    int changes = 0;
    std::array<double, kDelays> share{};
  };
  /// A period in which another sender acted on the treads, from its first to its last sign.
  struct Spell {
    std::string name;
    TimePoint first;
    TimePoint last;
  };

  /// The last instant, at or before the report, at which these speeds were commanded.
  std::optional<TimePoint> commanded_until(const DrivenMessage& driven) const;
  /// The reason why the treads are not known to obey.
  std::string why_not_obeyed(TimePoint now) const;
  std::optional<Trouble> trouble_of(const std::optional<Spell>& spell, const std::string& what,
                                    TimePoint now) const;
  std::optional<Trouble> trouble_of_silent_kind(TimePoint now) const;
  std::optional<Trouble> trouble_of_driver(TimePoint now);
  std::optional<Trouble> trouble_of_obedience(TimePoint now);
  Commanded commanded_at(TimePoint time) const;
  void forget_changes();
  void note_obeyed(const DrivenMessage& driven, TimePoint until);
  void note_said(const DrivenMessage& driven);
  void compare_changes(const DrivenMessage& driven);
  /// Number of delays in `Follows::share` that are within the time for which the treads may
  /// disobey.
  std::ptrdiff_t prompt_delays() const;
  std::string why_behind() const;
  std::string why_behind(const Follows& follows) const;
  /// Finds speeds that were commanded repeatedly, each time briefly, but that the driver does not
  /// report.
  std::optional<Trouble> trouble_of_not_done(TimePoint now) const;
  bool listens(const std::string& name) const;
  bool is_quiet(TimePoint now) const;
  static void extend(std::optional<Spell>& spell, const std::string& name, TimePoint at);

  Limits limits_;
  std::deque<Commanded> commands_;
  std::vector<Listener> listeners_;
  TimePoint listened_{};                ///< the last time when a driver was connected
  std::optional<DrivenMessage> last_;   ///< from the driver; outside runs from any sender
  std::optional<DrivenMessage> other_;  ///< the last report from another sender than `last_`
  std::optional<Spell> rival_;

  // State of the present or the last run.
  bool runs_ = false;
  TimePoint begun_{};
  std::string driver_;  ///< the driver whose reports count; empty: none has reported
  TimePoint obeyed_{};  ///< the last time when the treads are known to have executed a command
  /// Robots have few different speeds, which recur, so that a late driver may look like a prompt
  /// one. The times of changes reveal it: either early, if few late ones match, or later, if most
  /// do.
  std::array<Follows, 2> follows_;
  TimePoint changed_{};            ///< time of the last change
  std::optional<TimePoint> held_;  ///< since then the treads must stand still, until the driver
                                   ///< reports that they do
  TimePoint stopped_{};            ///< last report that the treads stand still, as commanded

  Duration longest_off_{};
  int strange_ = 0;  ///< number of successive reports of speeds that were never commanded
  /// How long the treads were not known to obey: at present, and earlier in the same spell. Treads
  /// that stand still because the node stopped them count as obeying only at that moment.
  TimePoint unobeyed_since_{};
  TimePoint unobeyed_at_{};
  Duration unobeyed_{};
  Duration unobeyed_before_{};
  std::optional<Spell> second_;  ///< another sender that also drives the treads
  std::vector<std::string> listened_at_start_;
  std::vector<Listener> lively_;  ///< the listeners at the start that gave signs of life then
  std::vector<std::string> came_later_;
  std::vector<std::string> went_;
  TimePoint replaced_{};  ///< the last time when one of the listeners at the start was connected
};

}  // namespace swarmsmith
