#include "robot/runtime/driver_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"

namespace swarmsmith {
namespace {

/// Tolerance for rounding in drivers: the published one rounds to 1 cm/s.
constexpr double kSame_mps = 0.011;
/// How long commands are remembered, to distinguish a slow driver from one that obeys another
/// sender.
constexpr Duration kMemory = std::chrono::seconds(10);
/// Signs of another sender within this time of each other belong to one spell.
constexpr Duration kSpell = std::chrono::seconds(3);
/// A driver reports its speeds several times a second.
constexpr Duration kUsualSilence = std::chrono::milliseconds(250);

constexpr Duration kDelayStep = std::chrono::milliseconds(50);

bool same(double a, double b) {
  return std::fabs(a - b) <= kSame_mps;
}

template <class Command>
bool is_same(const Command& command, const DrivenMessage& driven) {
  return same(command.left_mps, driven.left_mps) && same(command.right_mps, driven.right_mps);
}

std::string speeds(double left_mps, double right_mps) {
  return fmt::format("{:.3g} and {:.3g} m/s", left_mps, right_mps);
}

std::string names_of(const std::vector<Listener>& listeners) {
  std::string text;
  for (const Listener& one : listeners)
    text += (text.empty() ? "" : ", ") + one.name;
  return text;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

DriverWatch::DriverWatch(Limits limits) : limits_(limits) {
  SWARMSMITH_ASSERT(limits_.hold >= Duration::zero(), "the time that a driver has is not negative");
  SWARMSMITH_ASSERT(limits_.hold <= limits_.give_up, "treads are held before a run is given up");
  forget_changes();
}

void DriverWatch::forget_changes() {
  follows_ = {Follows{.least = 12, .most = 25, .better = 0.2},
              Follows{.least = 60, .most = 120, .better = 0.08}};
}

bool DriverWatch::listens(const std::string& name) const {
  return std::ranges::find(listeners_, name, &Listener::name) != listeners_.end();
}

bool DriverWatch::is_quiet(TimePoint now) const {
  return !last_ || now - last_->arrival.at > kUsualSilence;
}

void DriverWatch::commanded(TimePoint at, double left_mps, double right_mps) {
  SWARMSMITH_ASSERT(std::isfinite(left_mps) && std::isfinite(right_mps), "a command is two speeds");
  SWARMSMITH_ASSERT(commands_.empty() || commands_.back().from <= at,
                    "commands are in the order of their times");
  while (commands_.size() > 1 && at - commands_[1].from > kMemory)
    commands_.pop_front();
  // The front one is kept as long as it was valid at any time within kMemory.
  const bool is_new = commands_.empty() || commands_.back().left_mps != left_mps ||
                      commands_.back().right_mps != right_mps;
  if (is_new) commands_.push_back({at, left_mps, right_mps});
}

/// The newest match counts, so a report is never taken to be later than it may be: speeds that were
/// commanded twice give a late driver the benefit of the doubt. `compare_changes` is for such
/// drivers.
std::optional<TimePoint> DriverWatch::commanded_until(const DrivenMessage& driven) const {
  TimePoint until = driven.arrival.at;
  for (auto command = commands_.rbegin(); command != commands_.rend(); ++command) {
    if (command->from > driven.arrival.at) continue;
    if (is_same(*command, driven)) return until;
    until = command->from;
  }
  return std::nullopt;
}

DriverWatch::Commanded DriverWatch::commanded_at(TimePoint time) const {
  for (auto command = commands_.rbegin(); command != commands_.rend(); ++command) {
    if (command->from <= time) return *command;
  }
  return commands_.empty() ? Commanded{} : commands_.front();
}

void DriverWatch::compare_changes(const DrivenMessage& driven) {
  // Only changes are compared: a driver that goes on with one speed matches commands of many
  // delays.
  const bool changed =
      last_ && last_->sender == driven.sender &&
      !(same(last_->left_mps, driven.left_mps) && same(last_->right_mps, driven.right_mps));
  if (!changed) return;
  changed_ = driven.arrival.at;
  for (Follows& follows : follows_)
    // With this, `share` is the mean over the first `most` changes, and afterwards forgets older
    // ones with the weight 1 / `most`.
    follows.changes = std::min(follows.changes + 1, follows.most);
  for (std::size_t i = 0; i < Follows::kDelays; ++i) {
    const Commanded then = commanded_at(driven.arrival.at - static_cast<int>(i) * kDelayStep);
    const double is_it = is_same(then, driven) ? 1 : 0;
    for (Follows& follows : follows_)
      follows.share[i] += (is_it - follows.share[i]) / follows.changes;
  }
}

std::ptrdiff_t DriverWatch::prompt_delays() const {
  const auto delays = static_cast<std::ptrdiff_t>(limits_.hold / kDelayStep) + 1;
  SWARMSMITH_ASSERT(delays >= 1, "a driver that obeys at once is prompt");
  return std::min<std::ptrdiff_t>(delays, Follows::kDelays);
}

/// The reason, if the driver's changes follow earlier commands much better than prompt ones.
std::string DriverWatch::why_behind(const Follows& follows) const {
  constexpr double kSure = 0.9;
  SWARMSMITH_ASSERT(follows.changes <= follows.most, "older changes are forgotten");
  if (follows.changes < follows.least) return {};
  const auto& share = follows.share;
  // A late delay must explain almost all changes, and clearly more than each delay that is allowed:
  // commands that are repeated with a period match late delays of a prompt driver, too.
  const auto late = share.begin() + prompt_delays();
  // `hold` is 3 s or more.
  if (late == share.end()) return {};  // such long delays are not remembered
  const double prompt = *std::max_element(share.begin(), late);
  const auto best = std::max_element(late, share.end());
  if (*best < kSure || *best - prompt < follows.better) return {};
  return fmt::format("{} makes each change {:.2f} s after its command", driver_,
                     seconds_of((best - share.begin()) * kDelayStep));
}

std::string DriverWatch::why_behind() const {
  for (const Follows& follows : follows_) {
    if (auto why = why_behind(follows); !why.empty()) return why;
  }
  return {};
}

void DriverWatch::note_obeyed(const DrivenMessage& driven, TimePoint until) {
  SWARMSMITH_ASSERT(until <= driven.arrival.at, "what it obeys was commanded before it said so");
  const bool stands = driven.left_mps == 0 && driven.right_mps == 0;
  // Standing treads do no harm: a late report of 0 does not count against the driver.
  const bool is_late = driven.arrival.at - until > limits_.hold;
  // An earlier prompt report does not excuse a late one. All late reports count the same, however
  // late they are, so that a single one does not end the run.
  obeyed_ = is_late && !stands ? std::min(obeyed_, driven.arrival.at - limits_.hold - kDelayStep)
                               : std::max(obeyed_, until);
  // A run that was held continues only after such a report (`trouble_of_driver`).
  if (stands) stopped_ = driven.arrival.at;
}

/// Marks each command with these speeds that was valid when the report came, or at most `hold`
/// before.
void DriverWatch::note_said(const DrivenMessage& driven) {
  TimePoint until = TimePoint::max();
  for (auto command = commands_.rbegin(); command != commands_.rend(); ++command) {
    if (until != TimePoint::max() && driven.arrival.at - until > limits_.hold) return;
    until = command->from;
    command->said |= until <= driven.arrival.at && is_same(*command, driven);
  }
}

std::optional<DriverWatch::Trouble> DriverWatch::trouble_of_not_done(TimePoint now) const {
  // Finds the last command whose time is over; all commands with the same speeds count.
  const Commanded* last = nullptr;
  TimePoint until = TimePoint::max();
  for (auto command = commands_.rbegin(); command != commands_.rend(); ++command) {
    const bool is_over = until != TimePoint::max() && now - until > limits_.hold;
    if (is_over) last = &*command;
    until = command->from;
    if (is_over) break;
  }
  if (last == nullptr || last->said) return std::nullopt;
  Duration sum{};
  int times = 0;
  for (std::size_t i = 0; i + 1 < commands_.size(); ++i) {
    const Commanded& command = commands_[i];
    const bool is_it =
        same(command.left_mps, last->left_mps) && same(command.right_mps, last->right_mps);
    if (!is_it || command.from < begun_ || now - commands_[i + 1].from <= limits_.hold) continue;
    // A driver that obeyed it once can do it: only the times after this count.
    if (command.said) {
      sum = {};
      times = 0;
      continue;
    }
    sum += commands_[i + 1].from - command.from;
    ++times;
  }
  // A driver that reads commands five times a second misses half of the commands that last 0.1 s.
  if (sum <= limits_.give_up) return std::nullopt;
  return Trouble{
      changed_, true, sum > 2 * limits_.give_up,
      fmt::format("{} ignored the command {}, which was given {} times, for {:.1f} s in all",
                  driver_, speeds(last->left_mps, last->right_mps), times, seconds_of(sum))};
}

void DriverWatch::extend(std::optional<Spell>& spell, const std::string& name, TimePoint at) {
  if (!spell || spell->name != name || at - spell->last > kSpell) spell = Spell{name, at, at};
  spell->last = at;
}

void DriverWatch::hear(const DrivenMessage& driven) {
  // Two senders in turn. `not_ready` refuses a start while both report.
  if (last_ && last_->sender != driven.sender && driven.arrival.at - last_->arrival.at <= kSpell)
    other_ = last_;
  if (!runs_) {
    last_ = driven;
    return;
  }
  // The first sender of a run's reports is its driver until the end. A later one is a second
  // driver, and the run ends if it goes on, whatever it reports (docs/robot-messages.md, "What the
  // driver says").
  if (driver_.empty() || driver_ == driven.sender) {
    driver_ = driven.sender;
    const auto until = commanded_until(driven);
    const bool stands = driven.left_mps == 0 && driven.right_mps == 0;
    note_said(driven);
    compare_changes(driven);
    last_ = driven;
    // A driver may always stop the treads on its own, so 0 is not a strange speed.
    strange_ = until || stands ? 0 : strange_ + 1;
    if (until) note_obeyed(driven, *until);
    return;
  }
  extend(second_, driven.sender, driven.arrival.at);
}

void DriverWatch::hear(const RivalMessage& rival) {
  extend(rival_, rival.sender, rival.arrival.at);
}

void DriverWatch::set_listeners(std::vector<Listener> listeners, TimePoint now) {
  listeners_ = std::move(listeners);
  if (!listeners_.empty()) listened_ = now;
  bool any_of_start = listened_at_start_.empty();
  for (const Listener& one : listeners_) {
    const bool was_there = contains(listened_at_start_, one.name);
    any_of_start |= was_there;
    // Over ROS a listener does not say whether it drives: it may only record the speeds
    // (`Listener::drives`).
    if (runs_ && one.drives && !was_there && !contains(came_later_, one.name))
      came_later_.push_back(one.name);
  }
  // A new connection has another name, so a driver that was restarted counts as another driver.
  if (any_of_start) replaced_ = now;
  for (Listener& known : lively_) {
    const auto one = std::ranges::find(listeners_, known.name, &Listener::name);
    if (one != listeners_.end()) known.heard = std::max(known.heard, one->heard);
  }
  for (const std::string& name : listened_at_start_) {
    if (runs_ && !listens(name) && !contains(went_, name)) went_.push_back(name);
  }
}

void DriverWatch::begin(TimePoint start) {
  runs_ = true;
  // From the start, not from now: the treads need not obey before the agreed instant.
  begun_ = obeyed_ = replaced_ = changed_ = start;
  unobeyed_since_ = unobeyed_at_ = {};
  unobeyed_ = unobeyed_before_ = {};
  held_.reset();
  strange_ = 0;
  longest_off_ = {};
  forget_changes();
  second_.reset();
  rival_.reset();
  came_later_.clear();
  went_.clear();
  listened_at_start_.clear();
  lively_.clear();
  for (const Listener& one : listeners_) {
    listened_at_start_.push_back(one.name);
    // Only these can be missed later: a mere listener may never give a sign of life.
    if (listened_ - one.heard <= limits_.give_up) lively_.push_back(one);
  }
  driver_.clear();
  // A driver that has reported before the run must report in it. Otherwise a driver that hangs at
  // the start would pass for one of the kind that never reports.
  if (last_ && listens(last_->sender)) driver_ = last_->sender;
}

std::string DriverWatch::why_not_obeyed(TimePoint now) const {
  if (listeners_.empty())
    return driver_ + " has disconnected: no driver listens to the speeds of the treads";
  if (is_quiet(now)) {
    return second_ && now - second_->last <= kUsualSilence
               ? second_->name + " drives the treads in place of " + driver_
               : driver_ + " does not report what the treads do";
  }
  SWARMSMITH_ASSERT(last_, "a driver that is not quiet has said something");
  const Commanded wanted = commands_.empty() ? Commanded{} : commands_.back();
  const std::string told = driver_ + " reports " + speeds(last_->left_mps, last_->right_mps) +
                           ", and " + speeds(wanted.left_mps, wanted.right_mps) +
                           " are commanded: ";
  const bool stands = last_->left_mps == 0 && last_->right_mps == 0;
  const auto until = commanded_until(*last_);
  if (stands && (!until || now - *until > limits_.give_up)) return told + "it stopped them";
  if (until) {
    return told + fmt::format("it is {:.2f} s behind{}", seconds_of(last_->arrival.at - *until),
                              stands ? ", or stopped them" : "");
  }
  if (same(last_->left_mps, wanted.left_mps)) return told + "only the left one obeys";
  if (same(last_->right_mps, wanted.right_mps)) return told + "only the right one obeys";
  return told + "it follows other commands";
}

std::optional<DriverWatch::Trouble> DriverWatch::trouble_of(const std::optional<Spell>& spell,
                                                            const std::string& what,
                                                            TimePoint now) const {
  if (!spell || now - spell->last > kSpell) return std::nullopt;
  // A single message only holds the treads. A sender that goes on for longer than `give_up` ends
  // the run.
  const bool ends = spell->last - spell->first > limits_.give_up;
  // Its last speeds may still be driven for this time: a driver stops by itself only after it.
  if (!ends && now - spell->last > limits_.hold) return std::nullopt;
  return Trouble{spell->first, true, ends, spell->name + what};
}

/// docs/robot-messages.md, "What the driver says": here only signs of life are known.
/// For drivers that do not report their speeds.
std::optional<DriverWatch::Trouble> DriverWatch::trouble_of_silent_kind(TimePoint now) const {
  const auto since = [&](TimePoint time, std::string what) {
    return Trouble{time, now - time > limits_.hold, now - time > limits_.give_up, std::move(what)};
  };
  if (listeners_.empty())
    return since(std::max(listened_, obeyed_), "no driver listens to the speeds of the treads");
  // There are listeners, but none of those at the start.
  if (replaced_ < listened_)
    return since(replaced_, "the driver was replaced by " + names_of(listeners_));
  // Any client that declares itself a driver may be the real one; others may be mere listeners.
  TimePoint heard{};
  for (const Listener& one : lively_) {
    heard = std::max(heard, one.heard);
    if (one.drives && now - one.heard > limits_.give_up)
      return Trouble{one.heard, true, true, one.name + " does not respond"};
  }
  if (lively_.empty() || now - heard <= limits_.give_up) return std::nullopt;
  return Trouble{heard, true, true,
                 names_of(lively_) + (lively_.size() > 1 ? " do" : " does") + " not respond"};
}

std::optional<DriverWatch::Trouble> DriverWatch::trouble_of_driver(TimePoint now) {
  // Once the treads are held, they stay held until the driver reports a stop that is later: this
  // shows that it receives and follows commands again.
  auto trouble = trouble_of_obedience(now);
  if (trouble) {
    if (!held_) held_ = now;
  } else if (held_ && stopped_ > *held_) {
    held_.reset();
  } else if (held_) {
    // The reports of a late driver sometimes match by chance. Only the stop shows whether it
    // follows.
    trouble = Trouble{obeyed_, true, false, why_not_obeyed(now)};
  }
  return trouble;
}

std::optional<DriverWatch::Trouble> DriverWatch::trouble_of_obedience(TimePoint now) {
  constexpr int kStrange = 3;
  // A delay that explains the changes, or a command that is never done, counts even if the last
  // report matches what is commanded.
  if (auto why = why_behind(); !why.empty()) return Trouble{changed_, true, true, std::move(why)};
  auto missed = trouble_of_not_done(now);
  if (missed && missed->ends) return missed;
  if (now - obeyed_ <= limits_.hold) return missed;
  // Pieces in succession are added up, because treads that are held obey for a moment: without the
  // sum, a driver that never moves the treads would only alternate between these two states.
  if (now - unobeyed_at_ > kSpell) unobeyed_ = unobeyed_before_ = {};
  if (unobeyed_since_ != obeyed_) unobeyed_before_ += unobeyed_;
  unobeyed_since_ = obeyed_;
  unobeyed_at_ = now;
  unobeyed_ = now - obeyed_;
  // Several reports of speeds that were not commanded cannot be a delay, so the node does
  // not wait.
  const bool ends = strange_ >= kStrange || unobeyed_before_ + unobeyed_ > limits_.give_up;
  return Trouble{obeyed_, true, ends, why_not_obeyed(now)};
}

std::optional<DriverWatch::Trouble> DriverWatch::trouble(TimePoint now) {
  if (!runs_) return std::nullopt;
  const std::string beside =
      (is_quiet(now) ? " drives the treads in place of " : " also drives the treads, besides ") +
      driver_;
  // All of them are computed in each cycle: `trouble_of_driver` remembers how long the treads did
  // not obey, and the log gets the longest time of all.
  std::vector<std::optional<Trouble>> all = {trouble_of(rival_, " also commands the treads", now),
                                             trouble_of(second_, beside, now)};
  if (driver_.empty()) {
    all.push_back(trouble_of_silent_kind(now));
  } else {
    all.push_back(trouble_of_driver(now));
  }
  for (const auto& one : all) {
    if (one) longest_off_ = std::max(longest_off_, now - one->since);
  }
  // Also below `hold`, although this is not a trouble: the log has the measured value.
  if (!driver_.empty()) longest_off_ = std::max(longest_off_, now - obeyed_);
  const auto first = [&all](bool Trouble::*what) -> std::optional<Trouble> {
    for (const auto& one : all) {
      if (one && (*one).*what) return one;
    }
    return std::nullopt;
  };
  // A trouble that ends the run comes before an earlier one in the list that only holds it.
  if (auto end = first(&Trouble::ends)) return end;
  return first(&Trouble::holds);
}

std::vector<std::string> DriverWatch::not_ready(TimePoint now) const {
  std::vector<std::string> reasons;
  if (listeners_.empty()) {
    reasons.emplace_back("driver: no driver listens to the speeds of the treads");
    // A driver that has never reported may be of the kind that does not, and a run may start with
    // it.
  } else if (last_ && listens(last_->sender) && now - last_->arrival.at > limits_.give_up) {
    reasons.push_back(fmt::format("driver: {} has not reported what the treads do for {:.1f} s",
                                  last_->sender, seconds_of(now - last_->arrival.at)));
  }
  if (other_ && last_ && now - other_->arrival.at <= limits_.give_up) {
    reasons.push_back("driver: " + other_->sender + " and " + last_->sender +
                      " both say that they drive the treads");
  }
  if (rival_ && now - rival_->last <= limits_.give_up)
    reasons.push_back("driver: " + rival_->name + " also commands the treads");
  return reasons;
}

std::vector<std::string> DriverWatch::doubts() const {
  std::vector<std::string> doubts;
  if (driver_.empty()) {
    doubts.emplace_back(
        "no driver reports what the treads do (`driven`): if it stops obeying, nothing shows it");
    for (const std::string& name : went_)
      doubts.push_back(name +
                       " listened to the speeds of the treads, but disconnected during the run");
  }
  constexpr double kFollows = 0.6;
  // Not sure enough to end a run: the changes fit no allowed delay well, but no late one either.
  const Follows& soon = follows_.front();
  const auto late = soon.share.begin() + prompt_delays();
  if (soon.changes == soon.most && *std::max_element(soon.share.begin(), late) < kFollows)
    doubts.push_back(driver_ + " reports changes of speed that do not follow the commands");
  for (const std::string& name : came_later_)
    doubts.push_back(name + " connected during the run and says that it drives");
  return doubts;
}

}  // namespace swarmsmith
