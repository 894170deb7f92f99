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

/// Knows which nodes get the speeds of the treads, and asks them five times a second whether they
/// live: ROS itself keeps the connection of a process that hangs. Asks the master each second who
/// else publishes the same topic.
class ListenerWatch {
 public:
  /// Called with what a person should know, from a thread of its own.
  using OnTrouble = std::function<void(std::string text)>;

  explicit ListenerWatch(OnTrouble on_trouble);
  ListenerWatch(const ListenerWatch&) = delete;
  ListenerWatch& operator=(const ListenerWatch&) = delete;
  ~ListenerWatch();

  /// A node's connection came, or ended.
  void joined(const std::string& node);
  void left(const std::string& node);
  /// All but this node.
  std::vector<Listener> listeners() const;
  /// A node with the number of its connection, from the second on: "/driver (connection 2)". One of
  /// the same name that was started again is another one.
  std::string name_of(const std::string& node) const;

  bool listens(const std::string& node) const;

  void look_for_rivals(const std::string& topic);

 private:
  struct Known {
    int connection = 0;  ///< how many there were; 0: none yet
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
  std::map<std::string, std::string> places_;  ///< of nodes, as the master had them; of the thread
  std::map<std::string, bool> rivals_;         ///< that were told; of the thread
  std::thread thread_;
};

}  // namespace swarmsmith
