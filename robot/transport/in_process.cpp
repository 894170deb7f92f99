#include "robot/transport/in_process.h"

#include <utility>

#include "robot/transport/inbox.h"

namespace swarmsmith {

namespace {

TimePoint now() {
  return SystemClock().now();
}

}  // namespace

struct InProcessSwarm::Impl {
  struct Robot final : RobotEnd {
    Robot(Impl& of_swarm, std::size_t at, Keep keep) : swarm(&of_swarm), index(at), inbox(keep) {}

    std::optional<ToRobot> receive(TimePoint until) override { return inbox.take(until); }
    void send(const FromRobot& message) override {
      FromRobot sent = arrived(message);
      if (auto* wheels = std::get_if<WheelsMessage>(&sent); wheels && wheels->sender.empty())
        wheels->sender = swarm->names[index];
      if (const auto* state = std::get_if<StateMessage>(&sent))
        swarm->operating.inbox.put({index, *state});
      swarm->world.inbox.put({index, std::move(sent)});
    }
    std::vector<Listener> listeners() override { return {{"world", now()}}; }
    void flush(Duration) override {}

    Impl* swarm;
    std::size_t index;
    Inbox<ToRobot> inbox;
  };

  struct World final : WorldEnd {
    World(Impl& of_swarm, Keep keep) : swarm(&of_swarm), inbox(keep) {}

    std::size_t robots() const override { return swarm->names.size(); }
    const std::string& name(std::size_t robot) const override { return swarm->names[robot]; }
    std::optional<Received> receive(TimePoint until) override { return inbox.take(until); }
    void send(std::size_t robot, const ToRobot& message) override {
      ToRobot sent = arrived(message);
      if (auto* driven = std::get_if<DrivenMessage>(&sent); driven && driven->sender.empty())
        driven->sender = "world";
      swarm->robots[robot]->inbox.put(std::move(sent));
    }
    bool connected(std::size_t) override { return true; }
    void flush(Duration) override {}

    Impl* swarm;
    Inbox<Received> inbox;
  };

  struct Operator final : OperatorEnd {
    explicit Operator(Impl& of_swarm) : swarm(&of_swarm) {}

    std::size_t robots() const override { return swarm->names.size(); }
    const std::string& name(std::size_t robot) const override { return swarm->names[robot]; }
    std::optional<Received> receive(TimePoint until) override { return inbox.take(until); }
    void send(const OrderMessage& order) override {
      for (std::size_t i = 0; i < swarm->names.size(); ++i)
        swarm->world.send(i, order);
    }
    bool connected(std::size_t) override { return true; }
    void flush(Duration) override {}

    Impl* swarm;
    Inbox<Received> inbox{Keep::All};
  };

  Impl(std::vector<std::string> of_robots, Keep keep)
      : names(std::move(of_robots)), world(*this, keep), operating(*this) {
    for (std::size_t i = 0; i < names.size(); ++i)
      robots.push_back(std::make_unique<Robot>(*this, i, keep));
  }

  std::vector<std::string> names;
  World world;
  Operator operating;
  std::vector<std::unique_ptr<Robot>> robots;
};

InProcessSwarm::InProcessSwarm(std::vector<std::string> names, Keep keep)
    : impl_(std::make_unique<Impl>(std::move(names), keep)) {}
InProcessSwarm::~InProcessSwarm() = default;

RobotEnd& InProcessSwarm::robot(std::size_t robot) {
  return *impl_->robots[robot];
}

WorldEnd& InProcessSwarm::world() {
  return impl_->world;
}

OperatorEnd& InProcessSwarm::operator_end() {
  return impl_->operating;
}

}  // namespace swarmsmith
