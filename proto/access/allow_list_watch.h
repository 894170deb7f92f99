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

/// Looks at an AllowListFile once a second, in a thread of its own: folders of keys lie on network
/// file systems, which may hang, and the coordinator does not wait for them.
class AllowListWatch {
 public:
  /// Wall-clock time; another one in tests.
  using WallClock = std::function<std::chrono::sys_seconds()>;
  /// Called from the thread with what is wrong with a new list.
  using OnFaults = std::function<void(const std::vector<Error>&)>;

  AllowListWatch(AllowListFile file, OnFaults on_faults, WallClock clock = system_time,
                 std::chrono::milliseconds pause = std::chrono::seconds(1));
  ~AllowListWatch();

  /// The new clients, when they are others than the last time; does not wait.
  std::optional<std::vector<ListedClient>> take();
  /// Reads the file now, changed or not.
  void look_now();

  static std::chrono::sys_seconds system_time();

 private:
  void work();

  AllowListFile file_;  ///< the thread's
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
