#include "robot/ros/ros_ends.h"

#include <chrono>
#include <functional>
#include <limits>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "base/overloaded.h"
#include "robot/ros/internal/conversions.h"
#include "robot/ros/internal/listener_watch.h"
#include "robot/ros/internal/session.h"
#include "robot/transport/inbox.h"

namespace swarmsmith {

namespace {

constexpr const char* kOrderTopic = "/swarm/order";

constexpr std::uint32_t kUnlimited = 0;

/// Queue size for sensors and commands: the newest message, or all.
std::uint32_t queue_of(Keep keep) {
  return keep == Keep::All ? kUnlimited : 1;
}

/// Queue size for commands: room for one of each sender, so that a second sender is noticed.
std::uint32_t command_queue_of(Keep keep) {
  return keep == Keep::All ? kUnlimited : 10;
}

Arrival arrival_of(std::int64_t stamp_ns = 0) {
  return {SystemClock().now(), stamp_ns};
}

std::string range_topic(std::size_t sensor) {
  return "range_" + std::to_string(sensor);
}

const char* wheels_topic(WheelsForm form) {
  switch (form) {
    case WheelsForm::Doubles:
      return "wheels";
    case WheelsForm::Floats:
      return "wheels_speed";
    case WheelsForm::Twist:
      return "cmd_vel";
  }
  return "wheels";
}

/// Calls `use` with an empty message of the form's type.
template <class Use>
void with_wheels_type(WheelsForm form, const Use& use) {
  if (form == WheelsForm::Doubles) return use(std_msgs::Float64MultiArray());
  if (form == WheelsForm::Floats) return use(std_msgs::Float32MultiArray());
  use(geometry_msgs::Twist());
}

bool has_ranges_apart(const SensorTopics& sensors) {
  return sensors.ranges && sensors.ranges_apart && !sensors.senses;
}

/// Calls `use` with an empty message of each sensor topic, except separate ranges.
template <class Use>
void for_each_sensor(const SensorTopics& sensors, const Use& use) {
  if (sensors.senses) return use(SensesMessage());
  if (sensors.ranges && !sensors.ranges_apart) use(RangesMessage());
  if (sensors.ground_color) use(GroundColorMessage());
  if (sensors.scan) use(ScanMessage());
  if (sensors.neighbours) use(NeighboursMessage());
  if (sensors.light) use(LightMessage());
  if (sensors.battery) use(BatteryMessage());
}

template <class Ours>
RosType<Ours> ros_message(const Ours& ours) {
  RosType<Ours> theirs;
  to_ros(ours, theirs);
  return theirs;
}

/// The subscriptions of a ROS node.
struct Node {
  std::set<std::string> complained;  ///< topics; used only by the thread of callbacks
  std::unique_ptr<Session> session;
  std::vector<ros::Subscriber> subscribers;

  /// The callback gets the message and the name of its sender.
  template <class Message, class Callback>
  void subscribe(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue,
                 Callback callback) {
    using Event = ros::MessageEvent<const Message>;
    const boost::function<void(const Event&)> on_event = [callback](const Event& event) {
      callback(*event.getMessage(), event.getPublisherName());
    };
    subscribers.push_back(handle.subscribe<Message>(topic, queue, on_event, ros::VoidConstPtr(),
                                                    ros::TransportHints().tcpNoDelay()));
  }

  /// `put` gets the converted messages, and troubles: only the first one of each topic.
  template <class Ours, class Theirs = RosType<Ours>, class Put>
  void listen(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue, Put put) {
    const std::string whole_topic = handle.resolveName(topic);
    subscribe<Theirs>(
        handle, topic, queue,
        [this, topic, whole_topic, put](const Theirs& theirs, const std::string& sender) {
          Ours ours;
          ours.arrival = arrival_of();
          if constexpr (kHasSender<Ours>) ours.sender = sender;
          if (from_ros(theirs, ours)) return put(std::move(ours));
          if (!complained.insert(whole_topic).second) return;
          put(TroubleMessage{sender + " sent a message on " + topic +
                             " with a wrong count of values; such messages are ignored"});
        });
  }
};

/// ROS sends messages immediately, in its own threads; its interface has no way to wait for them.
void give_time(Duration most) {
  constexpr Duration kEnough = std::chrono::milliseconds(50);
  std::this_thread::sleep_for(std::min(most, kEnough));
}

class RosRobotEnd final : public RobotEnd {
 public:
  static Expected<std::unique_ptr<RobotEnd>> join(const std::string& name,
                                                  const RosOptions& options) {
    std::unique_ptr<RosRobotEnd> end(new RosRobotEnd(options.end));
    auto session = Session::join("/" + name, "control", false, options,
                                 [inbox = end->inbox_](std::string text, bool ended) {
                                   inbox->put(TroubleMessage{std::move(text), ended});
                                 });
    if (!session) return tl::unexpected(session.error());
    end->node_.session = std::move(*session);
    end->watch_ = std::make_unique<ListenerWatch>(
        [inbox = end->inbox_](std::string text) { inbox->put(TroubleMessage{std::move(text)}); });
    end->connect("/" + name);
    return end;
  }

  std::optional<ToRobot> receive(TimePoint until) override { return inbox_->take(until); }

  void send(const FromRobot& message) override {
    std::visit(Overloaded{[this](const WheelsMessage& wheels) {
                            with_wheels_type(options_.wheels, [&](auto theirs) {
                              to_ros(wheels, theirs);
                              publish_or_keep(wheels_, theirs);
                            });
                          },
                          [this](const AnswerMessage& answer) {
                            publish_or_keep(answers_, ros_message(answer));
                          },
                          [this](const LedsMessage& leds) { leds_.publish(ros_message(leds)); },
                          [this](const StateMessage& state) { state_.publish(ros_message(state)); },
                          [](const TroubleMessage&) {}},
               message);
  }
  std::vector<Listener> listeners() override { return watch_->listeners(); }
  void flush(Duration most) override { give_time(most); }

 private:
  explicit RosRobotEnd(const EndOptions& options)
      : options_(options), inbox_(std::make_shared<Inbox<ToRobot>>(options.keep)) {}

  /// A world sends its first question when this node is subscribed to it, but its own connection
  /// for answers may not yet exist. Then the answer waits for the connection.
  template <class Message>
  void publish_or_keep(const ros::Publisher& publisher, const Message& message) {
    if (options_.keep != Keep::All) return publisher.publish(message);
    const std::lock_guard lock(early_mutex_);
    if (publisher.getNumSubscribers() > 0) return publisher.publish(message);
    early_ = [publisher, message] { publisher.publish(message); };
  }
  void publish_early() {
    const std::lock_guard lock(early_mutex_);
    if (early_) std::exchange(early_, nullptr)();
  }
  template <class Message>
  ros::Publisher advertise(ros::NodeHandle& handle, const std::string& topic) {
    return handle.advertise<Message>(
        topic, queue_of(options_.keep),
        [this](const ros::SingleSubscriberPublisher& one) {
          publish_early();
          watch_->joined(one.getSubscriberName());
        },
        [this](const ros::SingleSubscriberPublisher& one) {
          watch_->left(one.getSubscriberName());
        });
  }
  /// Publishes commands, and subscribes to the commands of others to the same treads.
  template <class Message>
  void advertise_wheels(ros::NodeHandle& handle) {
    const std::string topic = wheels_topic(options_.wheels);
    wheels_ = advertise<Message>(handle, topic);
    if (options_.keep == Keep::All) return;
    node_.subscribe<Message>(handle, topic, command_queue_of(options_.keep),
                             [this](const Message&, const std::string& sender) {
                               if (sender == ros::this_node::getName()) return;
                               inbox_->put(RivalMessage{arrival_of(), sender});
                             });
    watch_->look_for_rivals(wheels_.getTopic());
  }

  void connect(const std::string& name_space) {
    ros::NodeHandle handle = node_.session->handle(name_space);
    const SensorTopics& sensors = options_.sensors;
    const std::uint32_t queue = queue_of(options_.keep);
    const auto put = [this](ToRobot message) { inbox_->put(std::move(message)); };
    for_each_sensor(sensors, [&](const auto& kind) {
      using Ours = std::decay_t<decltype(kind)>;
      node_.listen<Ours>(handle, Ours::kTopic, queue, put);
    });
    if (has_ranges_apart(sensors)) listen_to_ranges_apart(handle);
    if (sensors.driven) listen_to_driven(handle);
    node_.listen<OrderMessage>(handle, kOrderTopic, kUnlimited, put);
    if (sensors.senses) {
      answers_ = advertise<RosType<AnswerMessage>>(handle, AnswerMessage::kTopic);
    } else {
      with_wheels_type(options_.wheels, [&](const auto& theirs) {
        advertise_wheels<std::decay_t<decltype(theirs)>>(handle);
      });
    }
    leds_ = handle.advertise<RosType<LedsMessage>>(LedsMessage::kTopic, queue);
    // Advertised last: if the master knows this topic, it also knows all others
    // (RosWorldEnd::connected).
    state_ = handle.advertise<RosType<StateMessage>>(StateMessage::kTopic, 10, true);
    node_.session->spin(node_.subscribers);
  }

  void listen_to_ranges_apart(ros::NodeHandle& handle) {
    ranges_.ranges_m.assign(kRangeSensors, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < kRangeSensors; ++i) {
      node_.subscribe<sensor_msgs::Range>(
          handle, range_topic(i), queue_of(options_.keep),
          [this, i](const sensor_msgs::Range& range, const std::string&) { take_range(i, range); });
    }
  }

  void listen_to_driven(ros::NodeHandle& handle) {
    node_.listen<DrivenMessage>(
        handle, DrivenMessage::kTopic, command_queue_of(options_.keep),
        Overloaded{[this](DrivenMessage driven) {
                     if (!watch_->listens(driven.sender)) return not_believed(driven.sender);
                     driven.sender = watch_->name_of(driven.sender);
                     inbox_->put(std::move(driven));
                   },
                   [this](TroubleMessage trouble) { inbox_->put(std::move(trouble)); }});
  }

  /// Tolerates a few messages, because the first ones may come before its connection.
  void not_believed(const std::string& sender) {
    constexpr int kMany = 20;
    if (++deaf_[sender] != kMany) return;
    inbox_->put(TroubleMessage{sender + " reports what the treads do, but does not listen to their "
                                        "speeds; its reports are ignored",
                               false});
  }

  /// Combines eight topics into one message, whenever the last sensor of a round has arrived.
  void take_range(std::size_t sensor, const sensor_msgs::Range& range) {
    ranges_.ranges_m[sensor] = double{range.range};
    came_.insert(sensor);
    if (came_.size() < kRangeSensors) return;
    came_.clear();
    ranges_.arrival = arrival_of(nanoseconds(range.header.stamp));
    inbox_->put(ranges_);
  }

  EndOptions options_;
  std::shared_ptr<Inbox<ToRobot>> inbox_;
  /// Number of messages of each sender that reports speeds but does not receive them; used only by
  /// the thread of callbacks.
  std::map<std::string, int> deaf_;
  std::mutex early_mutex_;
  std::function<void()> early_;  ///< sends the message that had no receiver yet
  RangesMessage ranges_;         ///< for ranges_apart
  std::set<std::size_t> came_;
  ros::Publisher wheels_;
  ros::Publisher leds_;
  ros::Publisher state_;
  ros::Publisher answers_;
  std::unique_ptr<ListenerWatch> watch_;
  Node node_;  ///< destroyed first, because its callbacks use the other members
};

class RosWorldEnd final : public WorldEnd {
 public:
  static Expected<std::unique_ptr<WorldEnd>> join(const std::vector<std::string>& names,
                                                  const RosOptions& options) {
    std::unique_ptr<RosWorldEnd> end(new RosWorldEnd(names, options.end));
    auto session =
        Session::join("/", "world", false, options,
                      [inbox = end->inbox_, no_robot = names.size()](std::string text, bool ended) {
                        inbox->put({no_robot, TroubleMessage{std::move(text), ended}});
                      });
    if (!session) return tl::unexpected(session.error());
    end->node_.session = std::move(*session);
    for (std::size_t i = 0; i < names.size(); ++i)
      end->connect(i);
    end->node_.session->spin(end->node_.subscribers);
    return end;
  }

  std::size_t robots() const override { return names_.size(); }
  const std::string& name(std::size_t robot) const override { return names_[robot]; }
  std::optional<Received> receive(TimePoint until) override { return inbox_->take(until); }

  void send(std::size_t robot, const ToRobot& message) override {
    std::visit(
        [&](const auto& ours) {
          using Ours = std::decay_t<decltype(ours)>;
          if constexpr (std::is_same_v<Ours, RangesMessage>) {
            if (options_.sensors.ranges_apart) return send_apart(robot, ours);
          }
          if constexpr (kTravels<Ours>) publish(robot, Ours::kTopic, ros_message(ours));
        },
        message);
  }

  /// The node advertises its state last, so that the master then knows all its subscriptions; each
  /// of them must have a connection.
  bool connected(std::size_t robot) override {
    const Topics& topics = topics_[robot];
    if (topics.state.getNumPublishers() == 0) return false;
    SystemState state;
    if (!ask_system_state(state)) return false;
    bool listens = false;
    for (const auto& [name, publisher] : topics.sensors) {
      const std::size_t listeners = state.subscribers[publisher.getTopic()].size();
      if (publisher.getNumSubscribers() < listeners) return false;
      listens = listens || listeners > 0;
    }
    return listens;
  }
  void flush(Duration most) override { give_time(most); }

 private:
  struct Topics {
    std::map<std::string, ros::Publisher> sensors;
    ros::Subscriber state;
  };

  RosWorldEnd(std::vector<std::string> names, const EndOptions& options)
      : names_(std::move(names)),
        options_(options),
        inbox_(std::make_shared<Inbox<Received>>(options.keep)),
        topics_(names_.size()) {}

  template <class Message>
  void publish(std::size_t robot, const std::string& topic, const Message& message) {
    const auto found = topics_[robot].sensors.find(topic);
    if (found != topics_[robot].sensors.end()) found->second.publish(message);
  }

  void send_apart(std::size_t robot, const RangesMessage& ranges) {
    for (std::size_t i = 0; i < ranges.ranges_m.size() && i < kRangeSensors; ++i)
      publish(robot, range_topic(i), range_of(ranges, i));
  }

  void connect(std::size_t robot) {
    ros::NodeHandle handle = node_.session->handle("/" + names_[robot]);
    const SensorTopics& sensors = options_.sensors;
    const auto put = [this, robot](FromRobot message) { inbox_->put({robot, std::move(message)}); };
    const std::uint32_t queue = command_queue_of(options_.keep);
    offer_sensors(handle, robot);
    if (sensors.senses) {
      node_.listen<AnswerMessage>(handle, AnswerMessage::kTopic, queue, put);
    } else {
      with_wheels_type(options_.wheels, [&](const auto& theirs) {
        node_.listen<WheelsMessage, std::decay_t<decltype(theirs)>>(
            handle, wheels_topic(options_.wheels), queue, put);
      });
    }
    node_.listen<LedsMessage>(handle, LedsMessage::kTopic, queue, put);
    node_.listen<StateMessage>(handle, StateMessage::kTopic, kUnlimited, put);
    topics_[robot].state = node_.subscribers.back();
  }

  void offer_sensors(ros::NodeHandle& handle, std::size_t robot) {
    const SensorTopics& sensors = options_.sensors;
    const auto offer = [&](const std::string& topic, const auto& theirs) {
      topics_[robot].sensors[topic] =
          handle.advertise<std::decay_t<decltype(theirs)>>(topic, queue_of(options_.keep));
    };
    for_each_sensor(sensors, [&](const auto& kind) {
      using Ours = std::decay_t<decltype(kind)>;
      offer(Ours::kTopic, RosType<Ours>());
    });
    for (std::size_t i = 0; has_ranges_apart(sensors) && i < kRangeSensors; ++i)
      offer(range_topic(i), sensor_msgs::Range());
    if (sensors.driven) offer(DrivenMessage::kTopic, RosType<DrivenMessage>());
  }

  std::vector<std::string> names_;
  EndOptions options_;
  std::shared_ptr<Inbox<Received>> inbox_;
  std::vector<Topics> topics_;
  Node node_;
};

class RosOperatorEnd final : public OperatorEnd {
 public:
  static Expected<std::unique_ptr<OperatorEnd>> join(const std::vector<std::string>& names,
                                                     const RosOptions& options) {
    std::unique_ptr<RosOperatorEnd> end(new RosOperatorEnd(names));
    auto session =
        Session::join("/", "operator", true, options,
                      [inbox = end->inbox_, no_robot = names.size()](std::string text, bool ended) {
                        inbox->put({no_robot, TroubleMessage{std::move(text), ended}});
                      });
    if (!session) return tl::unexpected(session.error());
    end->node_.session = std::move(*session);
    end->connect();
    return end;
  }

  std::size_t robots() const override { return names_.size(); }
  const std::string& name(std::size_t robot) const override { return names_[robot]; }
  std::optional<Received> receive(TimePoint until) override { return inbox_->take(until); }
  void send(const OrderMessage& order) override { orders_.publish(ros_message(order)); }

  /// The operator's own subscriptions, one per robot, must be connected first.
  bool connected(std::size_t robot) override {
    SystemState state;
    if (node_.subscribers[robot].getNumPublishers() == 0 || !ask_system_state(state)) return false;
    const std::vector<std::string>& listeners = state.subscribers[orders_.getTopic()];
    const std::string node = "/" + names_[robot] + "/control";
    return std::find(listeners.begin(), listeners.end(), node) != listeners.end() &&
           orders_.getNumSubscribers() >= listeners.size();
  }
  void flush(Duration most) override { give_time(most); }

 private:
  explicit RosOperatorEnd(std::vector<std::string> names)
      : names_(std::move(names)), inbox_(std::make_shared<Inbox<Received>>(Keep::All)) {}

  void connect() {
    ros::NodeHandle handle = node_.session->handle("/");
    for (std::size_t i = 0; i < names_.size(); ++i) {
      node_.listen<StateMessage>(handle, "/" + names_[i] + "/state", kUnlimited,
                                 [this, i](auto message) {
                                   inbox_->put({i, std::move(message)});
                                 });
    }
    orders_ = handle.advertise<RosType<OrderMessage>>(kOrderTopic, 10);
    node_.session->spin(node_.subscribers);
  }

  std::vector<std::string> names_;
  std::shared_ptr<Inbox<Received>> inbox_;
  ros::Publisher orders_;
  Node node_;
};

std::optional<Error> check_names(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (is_ros_name(name)) continue;
    return Error{ErrorKind::BadInput,
                 "a robot's name in ROS is a letter, then letters, digits and _, such as rvr1",
                 name};
  }
  return std::nullopt;
}

}  // namespace

bool has_ros() {
  return true;
}

Expected<std::unique_ptr<RobotEnd>> ros_robot_end(const std::string& name,
                                                  const RosOptions& options) {
  if (auto wrong = check_names({name})) return tl::unexpected(*wrong);
  return RosRobotEnd::join(name, options);
}

Expected<std::unique_ptr<WorldEnd>> ros_world_end(const std::vector<std::string>& names,
                                                  const RosOptions& options) {
  if (auto wrong = check_names(names)) return tl::unexpected(*wrong);
  return RosWorldEnd::join(names, options);
}

Expected<std::unique_ptr<OperatorEnd>> ros_operator_end(const std::vector<std::string>& names,
                                                        const RosOptions& options) {
  if (auto wrong = check_names(names)) return tl::unexpected(*wrong);
  return RosOperatorEnd::join(names, options);
}

}  // namespace swarmsmith
