#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "robot/transport/ends.h"

namespace swarmsmith {

/// Tracks the nodes that receive the speeds of the treads, and checks five times a second whether
/// they are alive, because ROS keeps the connection of a process that hangs. Asks the master every
/// second for other publishers of the same topic.
class ListenerWatch {
 public:
  /// Called with problems for the user, from a separate thread.
  using OnTrouble = std::function<void(std::string text)>;

  explicit ListenerWatch(OnTrouble on_trouble);
  ListenerWatch(const ListenerWatch&) = delete;
  ListenerWatch& operator=(const ListenerWatch&) = delete;
  ~ListenerWatch();

  /// A node has connected or disconnected.
  void joined(const std::string& node);
  void left(const std::string& node);
  /// All receiving nodes except this one.
  std::vector<Listener> listeners() const;
  /// The name of a node, with the number of its connection from the second on: "/driver (connection
  /// 2)". A restarted node of the same name thus counts as a different one.
  std::string name_of(const std::string& node) const;

  bool listens(const std::string& node) const;

  void look_for_rivals(const std::string& topic);

 private:
  struct Known {
    int connection = 0;  ///< number of connections so far; 0: none yet
    int open = 0;
    TimePoint heard{};
  };

  void run();
  void ask_all();
  void ask_master();

  OnTrouble on_trouble_;
  mutable std::mutex mutex_;
  std::condition_variable ending_;
  bool ends_ = false;
  std::map<std::string, Known> known_;
  std::string topic_;
  std::map<std::string, std::string> places_;  ///< addresses of nodes, as given by the master; used
                                               ///< only by the thread
  std::map<std::string, bool> rivals_;         ///< whether each was reported; used only by the
                                               ///< thread
  std::thread thread_;
};

}  // namespace swarmsmith
