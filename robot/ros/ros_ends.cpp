#include "robot/ros/ros_ends.h"

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/ColorRGBA.h>
#include <std_msgs/Float32MultiArray.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/String.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "robot/ros/internal/listener_watch.h"
#include "robot/ros/internal/range_array.h"
#include "robot/ros/internal/session.h"
#include "robot/transport/inbox.h"
#include "robot/transport/numbers.h"

namespace swarmsmith {

namespace {

constexpr const char* kOrderTopic = "/swarm/order";

/// Of the proximity sensors' driver (ros facts, 1.2).
constexpr float kRangeFieldOfView_rad = 0.2967F;
constexpr float kLeastRange_m = 0.05F;
constexpr float kMostRange_m = 2.0F;

constexpr std::uint32_t kUnlimited = 0;

/// Sensors and commands: the newest, or all of them.
std::uint32_t queue_of(Keep keep) {
  return keep == Keep::All ? kUnlimited : 1;
}

/// Of commands: with one of each sender, so that a second one is noticed.
std::uint32_t command_queue_of(Keep keep) {
  return keep == Keep::All ? kUnlimited : 10;
}

Arrival arrival_of(std::int64_t stamp_ns = 0) {
  return {SystemClock().now(), stamp_ns};
}

std::int64_t nanoseconds(const ros::Time& stamp) {
  return std::int64_t{stamp.sec} * 1'000'000'000 + stamp.nsec;
}

/// Times before 1970, which ROS has no stamps for, become 0: none.
ros::Time stamp_of(const Arrival& arrival) {
  ros::Time stamp;
  if (arrival.stamp_ns > 0) stamp.fromNSec(static_cast<std::uint64_t>(arrival.stamp_ns));
  return stamp;
}

template <class Array>
std::vector<double> as_doubles(const Array& values) {
  return {values.begin(), values.end()};
}

std::vector<float> as_floats(const std::vector<double>& values) {
  std::vector<float> floats;
  floats.reserve(values.size());
  for (const double value : values)
    floats.push_back(static_cast<float>(value));
  return floats;
}

std_msgs::Float64MultiArray doubles_message(std::vector<double> numbers) {
  std_msgs::Float64MultiArray message;
  message.data = std::move(numbers);
  return message;
}

std_msgs::String text_message(const std::string& text) {
  std_msgs::String message;
  message.data = text;
  return message;
}

sensor_msgs::Range range_message(const Arrival& arrival, std::size_t sensor, double range_m) {
  sensor_msgs::Range message;
  message.header.stamp = stamp_of(arrival);
  message.header.frame_id = "base_range_" + std::to_string(sensor);
  message.radiation_type = sensor_msgs::Range::INFRARED;
  message.field_of_view = kRangeFieldOfView_rad;
  message.min_range = kLeastRange_m;
  message.max_range = kMostRange_m;
  message.range = static_cast<float>(range_m);
  return message;
}

std::string range_topic(std::size_t sensor) {
  return "range_" + std::to_string(sensor);
}

/// Wheels as one of the three forms.
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

/// A publisher that has seen each of who will listen. Subscribes, too.
struct Node {
  std::unique_ptr<Session> session;
  std::vector<ros::Subscriber> subscribers;

  /// The callback gets (message, name of who sent it).
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
};

/// Says once a topic what is wrong with its messages.
class Complaints {
 public:
  bool first(const std::string& topic) { return topics_.insert(topic).second; }

 private:
  std::set<std::string> topics_;
};

/// Messages leave at once, in threads of ROS; there is nothing in its interface to wait for.
void give_time(Duration most) {
  constexpr Duration kEnough = std::chrono::milliseconds(50);
  std::this_thread::sleep_for(std::min(most, kEnough));
}

class RosRobotEnd final : public RobotEnd {
 public:
  static RosExpected<std::unique_ptr<RobotEnd>> join(const std::string& name,
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

  void send(const WheelsMessage& wheels) override {
    if (form_ == WheelsForm::Doubles)
      return publish_or_keep(wheels_, doubles_message(numbers_of(wheels)));
    if (form_ == WheelsForm::Floats) {
      std_msgs::Float32MultiArray message;
      message.data = as_floats(numbers_of(wheels));
      return publish_or_keep(wheels_, message);
    }
    geometry_msgs::Twist message;
    message.linear.x = (wheels.left_mps + wheels.right_mps) / 2;
    message.angular.z = (wheels.right_mps - wheels.left_mps) / kTreadDistance_m;
    publish_or_keep(wheels_, message);
  }
  void send(const LedsMessage& leds) override {
    std_msgs::Float32MultiArray message;
    message.data = as_floats(numbers_of(leds));
    leds_.publish(message);
  }
  void send(const StateMessage& state) override { state_.publish(text_message(state.text)); }
  void send(const AnswerMessage& answer) override {
    publish_or_keep(answers_, doubles_message(numbers_of(answer)));
  }
  std::vector<Listener> listeners() override { return watch_->listeners(); }
  void flush(Duration most) override { give_time(most); }

 private:
  explicit RosRobotEnd(const EndOptions& options)
      : options_(options),
        form_(options.wheels),
        by_number_(options.sensors.senses),
        inbox_(std::make_shared<RobotInbox>(options.keep)) {}

  /// A world sends its first question when this node listens to it; it may be that its own
  /// connection for answers does not stand yet. Then the answer waits for it.
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
  /// Commands go out, and those of others to the same treads come in.
  template <class Message>
  void advertise_wheels(ros::NodeHandle& handle) {
    const std::string topic = wheels_topic(form_);
    wheels_ = advertise<Message>(handle, topic);
    if (options_.keep == Keep::All) return;
    node_.subscribe<Message>(handle, topic, command_queue_of(options_.keep),
                             [this](const Message&, const std::string& sender) {
                               if (sender == ros::this_node::getName()) return;
                               inbox_->put(RivalMessage{arrival_of(), sender});
                             });
    watch_->look_for_rivals(wheels_.getTopic());
  }

  /// A message made of numbers.
  template <class Ours, class Theirs>
  void listen(ros::NodeHandle& handle, const std::string& topic) {
    node_.subscribe<Theirs>(
        handle, topic, queue_of(options_.keep),
        [this, topic](const Theirs& message, const std::string& sender) {
          Ours ours;
          ours.arrival = arrival_of();
          if (read_numbers(as_doubles(message.data), ours)) return inbox_->put(std::move(ours));
          if (complaints_.first(topic)) {
            inbox_->put(TroubleMessage{sender + " sent " + std::to_string(message.data.size()) +
                                           " numbers on " + topic +
                                           ", which are none of that kind; they are not used",
                                       false});
          }
        });
  }

  void connect(const std::string& name_space) {
    ros::NodeHandle handle = node_.session->handle(name_space);
    const SensorTopics& sensors = options_.sensors;
    if (sensors.senses) listen<SensesMessage, std_msgs::Float64MultiArray>(handle, "senses");
    if (!sensors.senses) connect_sensors(handle);
    node_.subscribe<std_msgs::String>(handle, kOrderTopic, kUnlimited,
                                      [this](const std_msgs::String& order, const std::string&) {
                                        inbox_->put(OrderMessage{arrival_of(), order.data});
                                      });
    const std::uint32_t queue = queue_of(options_.keep);
    if (sensors.senses) {
      answers_ = advertise<std_msgs::Float64MultiArray>(handle, AnswerMessage::kTopic);
    } else if (form_ == WheelsForm::Doubles) {
      advertise_wheels<std_msgs::Float64MultiArray>(handle);
    } else if (form_ == WheelsForm::Floats) {
      advertise_wheels<std_msgs::Float32MultiArray>(handle);
    } else {
      advertise_wheels<geometry_msgs::Twist>(handle);
    }
    leds_ = handle.advertise<std_msgs::Float32MultiArray>("leds", queue);
    // The last one: who sees it at the master sees all the others (RosWorldEnd::connected).
    state_ = handle.advertise<std_msgs::String>("state", 10, true);
    node_.session->spin(node_.subscribers);
  }

  void connect_sensors(ros::NodeHandle& handle) {
    const SensorTopics& sensors = options_.sensors;
    const std::uint32_t queue = queue_of(options_.keep);
    if (sensors.ranges && sensors.ranges_apart) {
      ranges_.ranges_m.assign(kRangeSensors, std::numeric_limits<double>::quiet_NaN());
      for (std::size_t i = 0; i < kRangeSensors; ++i) {
        node_.subscribe<sensor_msgs::Range>(
            handle, range_topic(i), queue,
            [this, i](const sensor_msgs::Range& range, const std::string&) {
              take_range(i, range);
            });
      }
    } else if (sensors.ranges) {
      node_.subscribe<teraranger_array::RangeArray>(
          handle, "ranges", queue,
          [this](const teraranger_array::RangeArray& array, const std::string&) {
            RangesMessage message{arrival_of(nanoseconds(array.header.stamp)), {}};
            for (const sensor_msgs::Range& range : array.ranges)
              message.ranges_m.push_back(double{range.range});
            inbox_->put(std::move(message));
          });
    }
    if (sensors.ground_color) {
      node_.subscribe<std_msgs::ColorRGBA>(
          handle, "ground_color", queue,
          [this](const std_msgs::ColorRGBA& color, const std::string&) {
            inbox_->put(GroundColorMessage{arrival_of(), double{color.r}, double{color.g},
                                           double{color.b}});
          });
    }
    if (sensors.scan) {
      node_.subscribe<sensor_msgs::LaserScan>(
          handle, "scan", queue, [this](const sensor_msgs::LaserScan& scan, const std::string&) {
            inbox_->put(ScanMessage{arrival_of(nanoseconds(scan.header.stamp)),
                                    double{scan.angle_min}, double{scan.angle_max},
                                    double{scan.angle_increment}, double{scan.range_min},
                                    double{scan.range_max}, as_doubles(scan.ranges)});
          });
    }
    if (sensors.neighbours)
      listen<NeighboursMessage, std_msgs::Float64MultiArray>(handle, "neighbours");
    if (sensors.light) listen<LightMessage, std_msgs::Float64MultiArray>(handle, "light");
    if (sensors.body) connect_body(handle);
    if (sensors.driven) {
      node_.subscribe<std_msgs::Float64MultiArray>(
          handle, DrivenMessage::kTopic, command_queue_of(options_.keep),
          [this](const std_msgs::Float64MultiArray& message, const std::string& sender) {
            if (!watch_->listens(sender)) return not_believed(sender);
            DrivenMessage driven;
            driven.arrival = arrival_of();
            driven.sender = watch_->name_of(sender);
            if (read_numbers(message.data, driven)) return inbox_->put(std::move(driven));
            if (complaints_.first(DrivenMessage::kTopic)) {
              inbox_->put(TroubleMessage{sender + " sent " + std::to_string(message.data.size()) +
                                             " numbers on driven, and two are wanted: left, right",
                                         false});
            }
          });
    }
  }

  /// Its first words may come before its connection.
  void not_believed(const std::string& sender) {
    constexpr int kMany = 20;
    if (++deaf_[sender] != kMany) return;
    inbox_->put(TroubleMessage{sender + " says what the treads do, and does not listen to their "
                                        "speeds; it is not believed",
                               false});
  }

  void connect_body(ros::NodeHandle& handle) {
    const std::uint32_t queue = queue_of(options_.keep);
    node_.subscribe<sensor_msgs::Imu>(
        handle, "imu", queue, [this](const sensor_msgs::Imu& imu, const std::string&) {
          inbox_->put(ImuMessage{
              arrival_of(nanoseconds(imu.header.stamp)),
              {imu.orientation.x, imu.orientation.y, imu.orientation.z, imu.orientation.w},
              {imu.angular_velocity.x, imu.angular_velocity.y, imu.angular_velocity.z},
              {imu.linear_acceleration.x, imu.linear_acceleration.y, imu.linear_acceleration.z}});
        });
    node_.subscribe<nav_msgs::Odometry>(
        handle, "odom", queue, [this](const nav_msgs::Odometry& odom, const std::string&) {
          const auto& q = odom.pose.pose.orientation;
          const double heading =
              std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
          inbox_->put(OdometryMessage{arrival_of(nanoseconds(odom.header.stamp)),
                                      odom.pose.pose.position.x, odom.pose.pose.position.y, heading,
                                      odom.twist.twist.linear.x, odom.twist.twist.linear.y,
                                      odom.twist.twist.angular.z});
        });
    node_.subscribe<sensor_msgs::BatteryState>(
        handle, "battery", queue,
        [this](const sensor_msgs::BatteryState& battery, const std::string&) {
          inbox_->put(BatteryMessage{arrival_of(nanoseconds(battery.header.stamp)),
                                     double{battery.voltage}, double{battery.percentage}});
        });
  }

  /// Eight topics become one message, whenever the last sensor of a round has come.
  void take_range(std::size_t sensor, const sensor_msgs::Range& range) {
    ranges_.ranges_m[sensor] = double{range.range};
    came_.insert(sensor);
    if (came_.size() < kRangeSensors) return;
    came_.clear();
    ranges_.arrival = arrival_of(nanoseconds(range.header.stamp));
    inbox_->put(ranges_);
  }

  EndOptions options_;
  WheelsForm form_;
  bool by_number_;
  std::shared_ptr<RobotInbox> inbox_;
  Complaints complaints_;            ///< of the spinner's thread, as is the next one
  std::map<std::string, int> deaf_;  ///< messages of those who drive and do not listen
  std::mutex early_mutex_;
  std::function<void()> early_;  ///< sends what had nobody to go to
  RangesMessage ranges_;         ///< with ranges_apart
  std::set<std::size_t> came_;
  ros::Publisher wheels_;
  ros::Publisher leds_;
  ros::Publisher state_;
  ros::Publisher answers_;
  std::unique_ptr<ListenerWatch> watch_;
  Node node_;  ///< ends first: its callbacks use the others
};

class RosWorldEnd final : public WorldEnd {
 public:
  static RosExpected<std::unique_ptr<WorldEnd>> join(const std::vector<std::string>& names,
                                                     const RosOptions& options) {
    std::unique_ptr<RosWorldEnd> end(new RosWorldEnd(names, options.end));
    auto session =
        Session::join("/", "world", false, options,
                      [inbox = end->inbox_, nobody = names.size()](std::string text, bool ended) {
                        inbox->put(nobody, TroubleMessage{std::move(text), ended});
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

  void send(std::size_t robot, const RangesMessage& ranges) override {
    Topics& topics = topics_[robot];
    if (options_.sensors.ranges_apart) {
      for (std::size_t i = 0; i < ranges.ranges_m.size() && i < kRangeSensors; ++i)
        topics.sensors.at(range_topic(i))
            .publish(range_message(ranges.arrival, i, ranges.ranges_m[i]));
      return;
    }
    teraranger_array::RangeArray message;
    message.header.stamp = stamp_of(ranges.arrival);
    message.header.frame_id = "base_hub";
    for (std::size_t i = 0; i < ranges.ranges_m.size(); ++i)
      message.ranges.push_back(range_message(ranges.arrival, i, ranges.ranges_m[i]));
    publish(robot, "ranges", message);
  }
  void send(std::size_t robot, const GroundColorMessage& color) override {
    std_msgs::ColorRGBA message;
    message.r = static_cast<float>(color.r);
    message.g = static_cast<float>(color.g);
    message.b = static_cast<float>(color.b);
    message.a = 255;
    publish(robot, "ground_color", message);
  }
  void send(std::size_t robot, const ScanMessage& scan) override {
    sensor_msgs::LaserScan message;
    message.header.stamp = stamp_of(scan.arrival);
    message.header.frame_id = "laser_frame";
    message.angle_min = static_cast<float>(scan.angle_min_rad);
    message.angle_max = static_cast<float>(scan.angle_max_rad);
    message.angle_increment = static_cast<float>(scan.angle_increment_rad);
    message.range_min = static_cast<float>(scan.range_min_m);
    message.range_max = static_cast<float>(scan.range_max_m);
    message.ranges = as_floats(scan.ranges_m);
    publish(robot, "scan", message);
  }
  void send(std::size_t robot, const NeighboursMessage& neighbours) override {
    publish(robot, "neighbours", doubles_message(numbers_of(neighbours)));
  }
  void send(std::size_t robot, const LightMessage& light) override {
    publish(robot, "light", doubles_message(numbers_of(light)));
  }
  void send(std::size_t robot, const ImuMessage& imu) override {
    sensor_msgs::Imu message;
    message.header.stamp = stamp_of(imu.arrival);
    message.orientation.x = imu.orientation[0];
    message.orientation.y = imu.orientation[1];
    message.orientation.z = imu.orientation[2];
    message.orientation.w = imu.orientation[3];
    message.angular_velocity.x = imu.angular_velocity_radps[0];
    message.angular_velocity.y = imu.angular_velocity_radps[1];
    message.angular_velocity.z = imu.angular_velocity_radps[2];
    message.linear_acceleration.x = imu.acceleration_mps2[0];
    message.linear_acceleration.y = imu.acceleration_mps2[1];
    message.linear_acceleration.z = imu.acceleration_mps2[2];
    publish(robot, "imu", message);
  }
  void send(std::size_t robot, const OdometryMessage& odometry) override {
    nav_msgs::Odometry message;
    message.header.stamp = stamp_of(odometry.arrival);
    message.pose.pose.position.x = odometry.x_m;
    message.pose.pose.position.y = odometry.y_m;
    message.pose.pose.orientation.z = std::sin(odometry.heading_rad / 2);
    message.pose.pose.orientation.w = std::cos(odometry.heading_rad / 2);
    message.twist.twist.linear.x = odometry.vx_mps;
    message.twist.twist.linear.y = odometry.vy_mps;
    message.twist.twist.angular.z = odometry.turn_radps;
    publish(robot, "odom", message);
  }
  void send(std::size_t robot, const BatteryMessage& battery) override {
    sensor_msgs::BatteryState message;
    message.header.stamp = stamp_of(battery.arrival);
    message.voltage = static_cast<float>(battery.voltage_V);
    message.percentage = static_cast<float>(battery.charge);
    publish(robot, "battery", message);
  }
  void send(std::size_t robot, const DrivenMessage& driven) override {
    publish(robot, DrivenMessage::kTopic, doubles_message(numbers_of(driven)));
  }
  void send(std::size_t robot, const SensesMessage& senses) override {
    publish(robot, "senses", doubles_message(numbers_of(senses)));
  }

  /// The node advertises its state last, so that the master then knows all topics that it listens
  /// to; each must have its connection.
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
        inbox_(std::make_shared<WorldInbox>(options.keep)),
        topics_(names_.size()) {}

  template <class Message>
  void publish(std::size_t robot, const std::string& topic, const Message& message) {
    const auto found = topics_[robot].sensors.find(topic);
    if (found != topics_[robot].sensors.end()) found->second.publish(message);
  }

  template <class Ours, class Theirs>
  void listen(ros::NodeHandle& handle, std::size_t robot, const std::string& topic) {
    node_.subscribe<Theirs>(
        handle, topic, command_queue_of(options_.keep),
        [this, robot, topic](const Theirs& message, const std::string& sender) {
          Ours ours;
          ours.arrival = arrival_of();
          if constexpr (std::is_same_v<Ours, WheelsMessage>) ours.sender = sender;
          if (read_numbers(as_doubles(message.data), ours))
            return inbox_->put(robot, std::move(ours));
          if (complaints_.first(names_[robot] + topic)) {
            inbox_->put(robot,
                        TroubleMessage{sender + " sent " + std::to_string(message.data.size()) +
                                           " numbers on " + topic +
                                           ", which are none of that kind; they are not used",
                                       false});
          }
        });
  }

  template <class Message>
  void offer(ros::NodeHandle& handle, std::size_t robot, const std::string& topic) {
    topics_[robot].sensors[topic] = handle.advertise<Message>(topic, queue_of(options_.keep));
  }

  void connect(std::size_t robot) {
    ros::NodeHandle handle = node_.session->handle("/" + names_[robot]);
    const SensorTopics& sensors = options_.sensors;
    if (sensors.senses) {
      offer<std_msgs::Float64MultiArray>(handle, robot, "senses");
      listen<AnswerMessage, std_msgs::Float64MultiArray>(handle, robot, "answer");
    } else {
      offer_sensors(handle, robot);
      listen_to_wheels(handle, robot);
    }
    listen<LedsMessage, std_msgs::Float32MultiArray>(handle, robot, "leds");
    node_.subscribe<std_msgs::String>(
        handle, "state", kUnlimited,
        [this, robot](const std_msgs::String& state, const std::string&) {
          inbox_->put(robot, StateMessage{arrival_of(), state.data});
        });
    topics_[robot].state = node_.subscribers.back();
  }

  void offer_sensors(ros::NodeHandle& handle, std::size_t robot) {
    const SensorTopics& sensors = options_.sensors;
    if (sensors.ranges && sensors.ranges_apart) {
      for (std::size_t i = 0; i < kRangeSensors; ++i)
        offer<sensor_msgs::Range>(handle, robot, range_topic(i));
    } else if (sensors.ranges) {
      offer<teraranger_array::RangeArray>(handle, robot, "ranges");
    }
    if (sensors.ground_color) offer<std_msgs::ColorRGBA>(handle, robot, "ground_color");
    if (sensors.scan) offer<sensor_msgs::LaserScan>(handle, robot, "scan");
    if (sensors.neighbours) offer<std_msgs::Float64MultiArray>(handle, robot, "neighbours");
    if (sensors.light) offer<std_msgs::Float64MultiArray>(handle, robot, "light");
    if (sensors.driven) offer<std_msgs::Float64MultiArray>(handle, robot, DrivenMessage::kTopic);
    if (!sensors.body) return;
    offer<sensor_msgs::Imu>(handle, robot, "imu");
    offer<nav_msgs::Odometry>(handle, robot, "odom");
    offer<sensor_msgs::BatteryState>(handle, robot, "battery");
  }

  void listen_to_wheels(ros::NodeHandle& handle, std::size_t robot) {
    const std::string topic = wheels_topic(options_.wheels);
    if (options_.wheels == WheelsForm::Doubles)
      return listen<WheelsMessage, std_msgs::Float64MultiArray>(handle, robot, topic);
    if (options_.wheels == WheelsForm::Floats)
      return listen<WheelsMessage, std_msgs::Float32MultiArray>(handle, robot, topic);
    node_.subscribe<geometry_msgs::Twist>(
        handle, topic, command_queue_of(options_.keep),
        [this, robot](const geometry_msgs::Twist& twist, const std::string& sender) {
          const double half = twist.angular.z * kTreadDistance_m / 2;
          inbox_->put(robot, WheelsMessage{arrival_of(), twist.linear.x - half,
                                           twist.linear.x + half, -1, sender});
        });
  }

  std::vector<std::string> names_;
  EndOptions options_;
  std::shared_ptr<WorldInbox> inbox_;
  Complaints complaints_;
  std::vector<Topics> topics_;
  Node node_;
};

class RosOperatorEnd final : public OperatorEnd {
 public:
  static RosExpected<std::unique_ptr<OperatorEnd>> join(const std::vector<std::string>& names,
                                                        const RosOptions& options) {
    std::unique_ptr<RosOperatorEnd> end(new RosOperatorEnd(names));
    auto session =
        Session::join("/", "operator", true, options,
                      [inbox = end->inbox_, nobody = names.size()](std::string text, bool ended) {
                        inbox->put({nobody, TroubleMessage{std::move(text), ended}});
                      });
    if (!session) return tl::unexpected(session.error());
    end->node_.session = std::move(*session);
    end->connect();
    return end;
  }

  std::size_t robots() const override { return names_.size(); }
  const std::string& name(std::size_t robot) const override { return names_[robot]; }
  std::optional<Received> receive(TimePoint until) override { return inbox_->take(until); }
  void send(const OrderMessage& order) override { orders_.publish(text_message(order.text)); }

  /// The operator's own subscriptions come first, one a robot.
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
      : names_(std::move(names)), inbox_(std::make_shared<Inbox<Received>>()) {}

  void connect() {
    ros::NodeHandle handle = node_.session->handle("/");
    for (std::size_t i = 0; i < names_.size(); ++i) {
      node_.subscribe<std_msgs::String>(
          handle, "/" + names_[i] + "/state", kUnlimited,
          [this, i](const std_msgs::String& state, const std::string&) {
            inbox_->put({i, StateMessage{arrival_of(), state.data}});
          });
    }
    orders_ = handle.advertise<std_msgs::String>(kOrderTopic, 10);
    node_.session->spin(node_.subscribers);
  }

  std::vector<std::string> names_;
  std::shared_ptr<Inbox<Received>> inbox_;
  ros::Publisher orders_;
  Node node_;
};

std::optional<RosError> check_names(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (is_ros_name(name)) continue;
    return RosError{RosError::Kind::BadInput,
                    "a robot's name in ROS is a letter, then letters, digits and _, such as rvr1",
                    name};
  }
  return std::nullopt;
}

}  // namespace

bool has_ros() {
  return true;
}

RosExpected<std::unique_ptr<RobotEnd>> ros_robot_end(const std::string& name,
                                                     const RosOptions& options) {
  if (auto wrong = check_names({name})) return tl::unexpected(*wrong);
  return RosRobotEnd::join(name, options);
}

RosExpected<std::unique_ptr<WorldEnd>> ros_world_end(const std::vector<std::string>& names,
                                                     const RosOptions& options) {
  if (auto wrong = check_names(names)) return tl::unexpected(*wrong);
  return RosWorldEnd::join(names, options);
}

RosExpected<std::unique_ptr<OperatorEnd>> ros_operator_end(const std::vector<std::string>& names,
                                                           const RosOptions& options) {
  if (auto wrong = check_names(names)) return tl::unexpected(*wrong);
  return RosOperatorEnd::join(names, options);
}

}  // namespace swarmsmith
