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

/// This process's ROS node: joins the master, takes messages in a thread of its own, and watches
/// for what ROS does not tell.
class Session {
 public:
  /// Called with trouble, from any thread; `ended` when the node must go.
  using OnTrouble = std::function<void(std::string text, bool ended)>;

  /// `names_space` is "/rvr1" or "/", `node` without it.
  static Expected<std::unique_ptr<Session>> join(const std::string& name_space,
                                                 const std::string& node, bool unique_name,
                                                 const RosOptions& options, OnTrouble on_trouble);
  ~Session();

  /// A handle whose relative names are in the name space; callbacks come one at a time.
  ros::NodeHandle handle(const std::string& name_space);
  /// Callbacks come from here on. If the master knows who publishes a topic that this node listens
  /// to, and there is no connection within 2 s, that is said, with the name that could not be
  /// reached: ROS itself is silent about it (ros facts, 2.5).
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
  std::set<std::string> suspects_;  ///< nodes that could not be reached when last looked
  std::set<std::string> told_;      ///< nodes that it was said of
  std::thread watch_;
};

/// Nodes that publish and that subscribe each topic, as the master has them.
struct SystemState {
  std::map<std::string, std::vector<std::string>> publishers;
  std::map<std::string, std::vector<std::string>> subscribers;
};
/// False when the master does not answer.
bool ask_system_state(SystemState& state);

/// http://HOST:PORT/ as two texts; false when it is none. roscpp aborts the process on such.
bool split_uri(std::string uri, std::string& host, std::string& port);

/// Whether the text is a name as ROS has it for a robot: a letter, then letters, digits and _.
bool is_ros_name(const std::string& name);

}  // namespace swarmsmith
