#include "proto/access/allow_list_watch.h"

#include <utility>

namespace swarmsmith {

AllowListWatch::AllowListWatch(AllowListFile file, OnFaults on_faults, WallClock clock,
                               std::chrono::milliseconds pause)
    : file_(std::move(file)),
      on_faults_(std::move(on_faults)),
      clock_(std::move(clock)),
      pause_(pause),
      thread_([this] { work(); }) {}

AllowListWatch::~AllowListWatch() {
  {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::optional<std::vector<ListedClient>> AllowListWatch::take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(clients_, std::nullopt);
}

void AllowListWatch::look_now() {
  {
    const std::scoped_lock lock(mutex_);
    look_now_ = true;
  }
  changed_.notify_all();
}

std::chrono::sys_seconds AllowListWatch::system_time() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

void AllowListWatch::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait_for(lock, pause_, [this] { return stop_ || look_now_; });
    if (stop_) return;
    const bool anyway = std::exchange(look_now_, false);
    lock.unlock();
    const AllowListFile::Look look = file_.look(clock_(), anyway);
    if (!look.faults.empty()) on_faults_(look.faults);
    lock.lock();
    if (look.changed) clients_ = file_.clients();
  }
}

}  // namespace swarmsmith
