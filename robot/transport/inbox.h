#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "base/clock.h"
#include "robot/transport/ends.h"
#include "robot/transport/messages.h"

namespace swarmsmith {

/// Of these the newest counts, and none waits behind it, unless all are kept (Keep::All).
template <class Message>
inline constexpr bool kNewestCounts =
    !std::is_same_v<Message, OrderMessage> && !std::is_same_v<Message, StateMessage> &&
    !std::is_same_v<Message, TroubleMessage>;

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

  /// The same; of those that wait, the first that `is_older` knows is dropped.
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

/// What came for a robot's node.
class RobotInbox {
 public:
  explicit RobotInbox(Keep keep) : keep_(keep) {}

  template <class Message>
  void put(Message message) {
    if (keep_ == Keep::All || !kNewestCounts<Message>) return inbox_.put(std::move(message));
    if constexpr (std::is_same_v<Message, DrivenMessage> || std::is_same_v<Message, RivalMessage>) {
      const std::string sender = message.sender;  // a second one must be noticed
      return inbox_.put_newest(std::move(message), [&sender](const ToRobot& old) {
        const auto* of_kind = std::get_if<Message>(&old);
        return of_kind != nullptr && of_kind->sender == sender;
      });
    }
    inbox_.put_newest(std::move(message),
                      [](const ToRobot& old) { return std::holds_alternative<Message>(old); });
  }
  std::optional<ToRobot> take(TimePoint until) { return inbox_.take(until); }

 private:
  Keep keep_;
  Inbox<ToRobot> inbox_;
};

/// What came for a world.
class WorldInbox {
 public:
  explicit WorldInbox(Keep keep) : keep_(keep) {}

  template <class Message>
  void put(std::size_t robot, Message message) {
    if (keep_ == Keep::All || !kNewestCounts<Message>)
      return inbox_.put({robot, std::move(message)});
    std::string sender;  // of commands: a driver must notice a second one
    if constexpr (std::is_same_v<Message, WheelsMessage>) sender = message.sender;
    inbox_.put_newest({robot, std::move(message)}, [&](const WorldEnd::Received& old) {
      if (old.robot != robot || !std::holds_alternative<Message>(old.message)) return false;
      if constexpr (std::is_same_v<Message, WheelsMessage>)
        return std::get<WheelsMessage>(old.message).sender == sender;
      return true;
    });
  }
  std::optional<WorldEnd::Received> take(TimePoint until) { return inbox_.take(until); }

 private:
  Keep keep_;
  Inbox<WorldEnd::Received> inbox_;
};

}  // namespace swarmsmith
