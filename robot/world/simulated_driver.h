#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "robot/transport/messages.h"

namespace swarmsmith {

/// The driver of a simulated robot, with the behaviour required of a real one (ros facts, 3.6 and
/// 3.8): it obeys only one sender of commands, and stops the treads when commands stop arriving.
/// Pure.
class SimulatedDriver {
 public:
  /// After this time without a command, the treads stop.
  static constexpr Duration kSilence = std::chrono::milliseconds(300);
  /// If two senders are heard within this time, the treads stop until only one has sent for the
  /// same time.
  static constexpr Duration kRivals = std::chrono::seconds(1);

  struct Treads {
    double left_mps = 0;
    double right_mps = 0;

    bool move() const { return left_mps != 0 || right_mps != 0; }
  };

  void hear(const WheelsMessage& wheels);
  /// The speeds that the treads must have from `now` on, if they change.
  std::optional<Treads> act(TimePoint now);

  /// The present speeds of the treads.
  const Treads& treads() const { return treads_; }
  /// Whether the treads stand still because commands stopped arriving, or because there are two
  /// senders.
  bool silent() const { return silent_; }
  bool has_rivals() const { return rivals_; }
  /// Remarks for the user since the last call: "no command for 300 ms: treads stopped".
  std::vector<std::string> take_events();

 private:
  struct Sender {
    std::string name;
    TimePoint heard;
  };

  std::optional<WheelsMessage> pending_;
  std::vector<Sender> senders_;
  Treads treads_;
  TimePoint heard_{};
  bool silent_ = true;
  bool rivals_ = false;
  bool broken_ = false;  ///< the last command was not finite
  std::vector<std::string> events_;
};

}  // namespace swarmsmith
