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

/// Orders and states are kept all, of anything else the newest.
template <class Variant>
bool keeps_all(const Variant& message) {
  return std::visit(
      [](const auto& one) {
        using Message = std::decay_t<decltype(one)>;
        return std::is_same_v<Message, OrderMessage> || std::is_same_v<Message, StateMessage> ||
               std::is_same_v<Message, TroubleMessage>;
      },
      message);
}

}  // namespace

struct InProcessSwarm::Impl {
  struct Robot final : RobotEnd {
    Robot(Impl& of_swarm, std::size_t at) : swarm(&of_swarm), index(at) {}

    std::optional<ToRobot> receive(TimePoint until) override { return inbox.take(until); }
    void send(const WheelsMessage& wheels) override {
      WheelsMessage sent = wheels;
      if (sent.sender.empty()) sent.sender = swarm->names[index];
      swarm->to_world(index, arrived(std::move(sent)));
    }
    void send(const LedsMessage& leds) override { swarm->to_world(index, arrived(leds)); }
    void send(const StateMessage& state) override {
      swarm->to_world(index, arrived(state));
      swarm->operating.inbox.put({index, arrived(state)});
    }
    void send(const AnswerMessage& answer) override { swarm->to_world(index, arrived(answer)); }
    bool connected() override { return true; }
    void flush(Duration) override {}

    Impl* swarm;
    std::size_t index;
    Inbox<ToRobot> inbox;
  };

  struct World final : WorldEnd {
    explicit World(Impl& of_swarm) : swarm(&of_swarm) {}

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
    void send(std::size_t robot, const SensesMessage& m) override { swarm->to_robot(robot, m); }
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
        swarm->to_robot(i, order);
    }
    bool connected(std::size_t) override { return true; }
    void flush(Duration) override {}

    Impl* swarm;
    Inbox<Received> inbox;
  };

  Impl(std::vector<std::string> of_robots, Keep keeping)
      : names(std::move(of_robots)), keep(keeping), world(*this), operating(*this) {
    for (std::size_t i = 0; i < names.size(); ++i)
      robots.push_back(std::make_unique<Robot>(*this, i));
  }

  template <class Message>
  void to_robot(std::size_t robot, const Message& message) {
    Inbox<ToRobot>& inbox = robots[robot]->inbox;
    ToRobot sent = arrived(message);
    if (keep == Keep::All || keeps_all(sent)) {
      inbox.put(std::move(sent));
    } else {
      inbox.put_newest(std::move(sent),
                       [](const ToRobot& old) { return std::holds_alternative<Message>(old); });
    }
  }

  template <class Message>
  void to_world(std::size_t robot, Message message) {
    FromRobot sent = std::move(message);
    if (keep == Keep::All || keeps_all(sent)) {
      world.inbox.put({robot, std::move(sent)});
    } else {
      world.inbox.put_newest({robot, std::move(sent)}, [robot](const WorldEnd::Received& old) {
        return old.robot == robot && std::holds_alternative<Message>(old.message);
      });
    }
  }

  std::vector<std::string> names;
  Keep keep;
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
