#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "proto/access/allow_list_file.h"

namespace swarmsmith {

/// Checks an AllowListFile once a second in its own thread: folders with keys may be on network
/// file systems that hang, and the coordinator must not wait for them.
class AllowListWatch {
 public:
  /// Wall-clock time; tests use another clock.
  using WallClock = std::function<std::chrono::sys_seconds()>;
  /// Called from the thread with the errors in a new list.
  using OnFaults = std::function<void(const std::vector<Error>&)>;

  AllowListWatch(AllowListFile file, OnFaults on_faults, WallClock clock = system_time,
                 std::chrono::milliseconds pause = std::chrono::seconds(1));
  ~AllowListWatch();

  /// The new clients, if they have changed since the last call; does not wait.
  std::optional<std::vector<ListedClient>> take();
  /// Reads the file now, whether or not it has changed.
  void look_now();

  static std::chrono::sys_seconds system_time();

 private:
  void work();

  AllowListFile file_;  ///< used by the thread only
  OnFaults on_faults_;
  WallClock clock_;
  std::chrono::milliseconds pause_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::vector<ListedClient>> clients_;
  bool look_now_ = false;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace swarmsmith
