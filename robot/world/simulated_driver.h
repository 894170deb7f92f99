#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/clock.h"
#include "robot/transport/messages.h"

namespace swarmsmith {

/// The driver of a simulated robot, as a real one should be (ros facts, 3.6 and 3.8): it obeys one
/// sender of commands alone, and stops the treads when commands stop coming. Pure.
class SimulatedDriver {
 public:
  /// No command for so long: treads 0.
  static constexpr Duration kSilence = std::chrono::milliseconds(300);
  /// Two senders within so long: treads 0, until one alone has sent for as long.
  static constexpr Duration kRivals = std::chrono::seconds(1);

  struct Treads {
    double left_mps = 0;
    double right_mps = 0;

    bool move() const { return left_mps != 0 || right_mps != 0; }
  };

  void hear(const WheelsMessage& wheels);
  /// What the treads shall do from `now` on, if that is new.
  std::optional<Treads> act(TimePoint now);

  /// What the treads do.
  const Treads& treads() const { return treads_; }
  /// Whether it stands still because commands stopped coming, or two senders are there.
  bool silent() const { return silent_; }
  bool has_rivals() const { return rivals_; }
  /// What a person should know since the last call: "no command for 300 ms: treads stopped".
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
  bool broken_ = false;  ///< the last command was not a number
  std::vector<std::string> events_;
};

}  // namespace swarmsmith
