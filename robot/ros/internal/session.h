#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "robot/ros/ros_ends.h"

namespace swarmsmith {

/// The ROS node of this process: joins the master, receives messages in its own thread, and watches
/// for problems that ROS does not report.
class Session {
 public:
  /// Called with a problem, from any thread; `ended` is true when the node must end.
  using OnTrouble = std::function<void(std::string text, bool ended)>;

  /// `name_space` is "/rvr1" or "/", `node` the name without it.
  static Expected<std::unique_ptr<Session>> join(const std::string& name_space,
                                                 const std::string& node, bool unique_name,
                                                 const RosOptions& options, OnTrouble on_trouble);
  ~Session();

  /// A handle whose relative names are in the name space; callbacks run one at a time.
  ros::NodeHandle handle(const std::string& name_space);
  /// From here on callbacks run. If the master knows a publisher of a subscribed topic, and there
  /// is no connection within 2 s, this is reported, with the name that could not be reached: ROS
  /// itself does not report it (ros facts, 2.5).
  void spin(std::vector<ros::Subscriber> subscribers);

 private:
  explicit Session(OnTrouble on_trouble) : on_trouble_(std::move(on_trouble)) {}
  void look_for_unreachable();
  void run_watch();

  OnTrouble on_trouble_;
  ros::CallbackQueue queue_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  std::mutex mutex_;
  std::condition_variable ending_;
  bool ends_ = false;
  std::vector<ros::Subscriber> subscribers_;
  std::set<std::string> suspects_;  ///< nodes that were unreachable at the last look
  std::set<std::string> told_;      ///< nodes that were reported
  std::thread watch_;
};

/// The nodes that publish and that subscribe to each topic, according to the master.
struct SystemState {
  std::map<std::string, std::vector<std::string>> publishers;
  std::map<std::string, std::vector<std::string>> subscribers;
};
/// False when the master does not answer.
bool ask_system_state(SystemState& state);

/// Splits http://HOST:PORT/ into two texts; false when the text has another form, for which roscpp
/// would abort the process.
bool split_uri(std::string uri, std::string& host, std::string& port);

/// Whether the text is valid as a robot's name in ROS: a letter, then letters, digits and _.
bool is_ros_name(const std::string& name);

}  // namespace swarmsmith
