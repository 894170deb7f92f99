#include "robot/transport/in_process.h"

#include <utility>

#include "robot/transport/inbox.h"

namespace swarmsmith {

namespace {

TimePoint now() {
  return SystemClock().now();
}

template <class Message>
Message arrived(Message message) {
  message.arrival.at = now();
  return message;
}

}  // namespace

struct InProcessSwarm::Impl {
  struct Robot final : RobotEnd {
    Robot(Impl& of_swarm, std::size_t at, Keep keep) : swarm(&of_swarm), index(at), inbox(keep) {}

    std::optional<ToRobot> receive(TimePoint until) override { return inbox.take(until); }
    void send(const WheelsMessage& wheels) override {
      WheelsMessage sent = wheels;
      if (sent.sender.empty()) sent.sender = swarm->names[index];
      swarm->world.inbox.put(index, arrived(std::move(sent)));
    }
    void send(const LedsMessage& leds) override { swarm->world.inbox.put(index, arrived(leds)); }
    void send(const StateMessage& state) override {
      swarm->world.inbox.put(index, arrived(state));
      swarm->operating.inbox.put({index, arrived(state)});
    }
    void send(const AnswerMessage& answer) override {
      swarm->world.inbox.put(index, arrived(answer));
    }
    std::vector<Listener> listeners() override { return {{"world", now()}}; }
    void flush(Duration) override {}

    Impl* swarm;
    std::size_t index;
    RobotInbox inbox;
  };

  struct World final : WorldEnd {
    World(Impl& of_swarm, Keep keep) : swarm(&of_swarm), inbox(keep) {}

    std::size_t robots() const override { return swarm->names.size(); }
    const std::string& name(std::size_t robot) const override { return swarm->names[robot]; }
    std::optional<Received> receive(TimePoint until) override { return inbox.take(until); }
    void send(std::size_t robot, const RangesMessage& m) override { swarm->to_robot(robot, m); }
    void send(std::size_t robot, const GroundColorMessage& m) override {
      swarm->to_robot(robot, m);
    }
    void send(std::size_t robot, const ScanMessage& m) override { swarm->to_robot(robot, m); }
    void send(std::size_t robot, const NeighboursMessage& m) override { swarm->to_robot(robot, m); }
    void send(std::size_t robot, const LightMessage& m) override { swarm->to_robot(robot, m); }
    void send(std::size_t robot, const ImuMessage& m) override { swarm->to_robot(robot, m); }
    void send(std::size_t robot, const OdometryMessage& m) override { swarm->to_robot(robot, m); }
    void send(std::size_t robot, const BatteryMessage& m) override { swarm->to_robot(robot, m); }
    void send(std::size_t robot, const DrivenMessage& m) override {
      DrivenMessage sent = m;
      if (sent.sender.empty()) sent.sender = "world";
      swarm->to_robot(robot, sent);
    }
    void send(std::size_t robot, const SensesMessage& m) override { swarm->to_robot(robot, m); }
    bool connected(std::size_t) override { return true; }
    void flush(Duration) override {}

    Impl* swarm;
    WorldInbox inbox;
  };

  struct Operator final : OperatorEnd {
    explicit Operator(Impl& of_swarm) : swarm(&of_swarm) {}

    std::size_t robots() const override { return swarm->names.size(); }
    const std::string& name(std::size_t robot) const override { return swarm->names[robot]; }
    std::optional<Received> receive(TimePoint until) override { return inbox.take(until); }
    void send(const OrderMessage& order) override {
      for (std::size_t i = 0; i < swarm->names.size(); ++i)
        swarm->to_robot(i, order);
    }
    bool connected(std::size_t) override { return true; }
    void flush(Duration) override {}

    Impl* swarm;
    Inbox<Received> inbox;
  };

  Impl(std::vector<std::string> of_robots, Keep keep)
      : names(std::move(of_robots)), world(*this, keep), operating(*this) {
    for (std::size_t i = 0; i < names.size(); ++i)
      robots.push_back(std::make_unique<Robot>(*this, i, keep));
  }

  template <class Message>
  void to_robot(std::size_t robot, const Message& message) {
    robots[robot]->inbox.put(arrived(message));
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
