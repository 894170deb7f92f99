#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "base/clock.h"

namespace swarmsmith {

/// Messages that came and were not taken yet, oldest first. Any thread puts, one takes.
template <class Message>
class Inbox {
 public:
  void put(Message message) {
    {
      const std::lock_guard lock(mutex_);
      messages_.push_back(std::move(message));
    }
    came_.notify_one();
  }

  /// The same, and one that `is_older` finds among those that wait is dropped.
  template <class IsOlder>
  void put_newest(Message message, const IsOlder& is_older) {
    {
      const std::lock_guard lock(mutex_);
      for (auto old = messages_.begin(); old != messages_.end(); ++old) {
        if (!is_older(*old)) continue;
        messages_.erase(old);
        break;
      }
      messages_.push_back(std::move(message));
    }
    came_.notify_one();
  }

  /// The oldest; waits for one until `until`.
  std::optional<Message> take(TimePoint until) {
    std::unique_lock lock(mutex_);
    came_.wait_until(lock, until, [this] { return !messages_.empty(); });
    if (messages_.empty()) return std::nullopt;
    std::optional<Message> oldest(std::move(messages_.front()));
    messages_.pop_front();
    return oldest;
  }

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Message> messages_;
};

}  // namespace swarmsmith
