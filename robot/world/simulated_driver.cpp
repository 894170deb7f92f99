#include "robot/world/simulated_driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace swarmsmith {

void SimulatedDriver::hear(const WheelsMessage& wheels) {
  const auto known = std::find_if(senders_.begin(), senders_.end(), [&](const Sender& sender) {
    return sender.name == wheels.sender;
  });
  if (known == senders_.end()) {
    senders_.push_back({wheels.sender, wheels.arrival.at});
  } else {
    known->heard = wheels.arrival.at;
  }
  heard_ = wheels.arrival.at;
  pending_ = wheels;
}

std::optional<SimulatedDriver::Treads> SimulatedDriver::act(TimePoint now) {
  std::erase_if(senders_, [now](const Sender& sender) { return now - sender.heard > kRivals; });
  const bool had_rivals = std::exchange(rivals_, senders_.size() > 1);
  if (rivals_ && !had_rivals) {
    events_.push_back("two nodes command it, " + senders_[0].name + " and " + senders_[1].name +
                      ": treads stopped until only one does");
  }
  if (had_rivals && !rivals_) events_.emplace_back("only one node commands it again");

  const bool was_silent = std::exchange(silent_, now - heard_ > kSilence);
  if (silent_ && !was_silent) {
    events_.emplace_back(treads_.move() ? "no command for 300 ms: treads stopped"
                                        : "no command for 300 ms; it stood still");
  }

  Treads wanted = treads_;
  bool is_new = false;
  if (const auto command = std::exchange(pending_, std::nullopt)) {
    const bool sound = std::isfinite(command->left_mps) && std::isfinite(command->right_mps);
    if (!sound && !broken_) events_.emplace_back("a command was not a number: treads stopped");
    broken_ = !sound;
    wanted = sound ? Treads{command->left_mps, command->right_mps} : Treads{};
    is_new = true;
  }
  if (silent_ || rivals_) wanted = {};
  if (!is_new && wanted.left_mps == treads_.left_mps && wanted.right_mps == treads_.right_mps)
    return std::nullopt;
  treads_ = wanted;
  return treads_;
}

std::vector<std::string> SimulatedDriver::take_events() {
  return std::exchange(events_, {});
}

}  // namespace swarmsmith
