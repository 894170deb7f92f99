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

/// Watches, while a run is on, whether the treads do what this node commands. A driver that says
/// what it has them do (DrivenMessage) is held to it: the last instant at which the treads are
/// known to have obeyed must not lie long ago. Of a driver that says nothing, only its connection
/// and its signs of life are known. Pure.
class DriverWatch {
 public:
  struct Limits {
    Duration hold = std::chrono::milliseconds(300);  ///< then the treads are to stand still
    Duration give_up = std::chrono::seconds(1);      ///< then the run is over
  };

  explicit DriverWatch(Limits limits);

  /// A command that was sent.
  void commanded(TimePoint at, double left_mps, double right_mps);
  void hear(const DrivenMessage& driven);
  void hear(const RivalMessage& rival);
  /// Who gets the commands at present.
  void set_listeners(std::vector<Listener> listeners, TimePoint now);

  /// A run begins then; a run is over.
  void begin(TimePoint start);
  void end() { runs_ = false; }

  /// What is wrong now, and since when.
  struct Trouble {
    TimePoint since;
    bool holds = false;  ///< the treads are to stand still
    bool ends = false;   ///< and the run is over
    std::string what;    ///< "/driver says nothing"
  };
  /// To be asked in each cycle.
  std::optional<Trouble> trouble(TimePoint now);

  /// Why no run can start; empty: it can.
  std::vector<std::string> not_ready(TimePoint now) const;
  /// Whether a driver has said what the treads do.
  bool is_told() const { return !driver_.empty(); }
  /// The longest time of the run for which the treads were not known to obey, or another one acted
  /// on them.
  Duration longest_off() const { return longest_off_; }
  /// What keeps a run from being VALID though nothing was seen to go wrong.
  std::vector<std::string> doubts() const;

 private:
  struct Commanded {
    TimePoint from;
    double left_mps = 0;
    double right_mps = 0;
    bool said = false;  ///< by the driver, then or a moment later
  };
  /// How often the driver's last changes were those that were commanded so long before, in steps of
  /// 50 ms; and how much better a late one must fit than a prompt one.
  struct Follows {
    static constexpr std::size_t kDelays = 61;
    int least = 0;  ///< changes to tell
    int most = 0;   ///< that are remembered
    double better = 0;
    int changes = 0;
    std::array<double, kDelays> share{};
  };
  /// Others that act on the treads, from their first to their last sign.
  struct Spell {
    std::string name;
    TimePoint first;
    TimePoint last;
  };

  /// The last instant, no later than then, at which these speeds were commanded.
  std::optional<TimePoint> commanded_until(const DrivenMessage& driven) const;
  /// Why the treads are not known to obey.
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
  /// The first so many of `Follows::share` are no longer than the treads may disobey.
  std::ptrdiff_t prompt_delays() const;
  std::string why_behind() const;
  std::string why_behind(const Follows& follows) const;
  /// Speeds that were commanded again and again, each time for a moment, and that it does not say.
  std::optional<Trouble> trouble_of_not_done(TimePoint now) const;
  bool listens(const std::string& name) const;
  bool is_quiet(TimePoint now) const;
  static void extend(std::optional<Spell>& spell, const std::string& name, TimePoint at);

  Limits limits_;
  std::deque<Commanded> commands_;
  std::vector<Listener> listeners_;
  TimePoint listened_{};                ///< when a driver last listened
  std::optional<DrivenMessage> last_;   ///< of the driver; outside of runs of any sender
  std::optional<DrivenMessage> other_;  ///< the last of another one than `last_`
  std::optional<Spell> rival_;

  // Of the present or the last run.
  bool runs_ = false;
  TimePoint begun_{};
  std::string driver_;  ///< whose word counts; empty: none has said anything
  TimePoint obeyed_{};  ///< when the treads last did what was commanded, as far as is known
  /// Robots have few speeds, which come again and again, so that a late one may look like a prompt
  /// one. What tells is when they change: soon, where few late ones fit; later, where most do.
  std::array<Follows, 2> follows_;
  TimePoint changed_{};            ///< the last time
  std::optional<TimePoint> held_;  ///< since then the treads are to stand, until the driver says so
  TimePoint stopped_{};            ///< when it last said that they stand, as was commanded

  Duration longest_off_{};
  int strange_ = 0;  ///< so often in succession it said what was never commanded
  /// For how long the treads were not known to obey: now, and before in the same spell. Treads that
  /// stand because the node stopped them obey for that moment alone.
  TimePoint unobeyed_since_{};
  TimePoint unobeyed_at_{};
  Duration unobeyed_{};
  Duration unobeyed_before_{};
  std::optional<Spell> second_;  ///< another one that drives the treads, too
  std::vector<std::string> listened_at_start_;
  std::vector<Listener> lively_;  ///< of these, who gave signs of life then
  std::vector<std::string> came_later_;
  std::vector<std::string> went_;
  TimePoint replaced_{};  ///< when one of those last listened
};

}  // namespace swarmsmith
