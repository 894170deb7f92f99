#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/clock.h"
#include "robot/transport/ends.h"
#include "robot/transport/messages.h"

namespace swarmsmith {

/// The message with the present time as arrival.
template <class Variant>
Variant arrived(Variant message) {
  std::visit(
      [](auto& one) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(one)>, TroubleMessage>)
          one.arrival.at = SystemClock().now();
      },
      message);
  return message;
}

/// Whether a newer message replaces an older one. Sensors and commands are replaced by newer ones,
/// but only by those of the same sender if a message has a sender, so that several senders are
/// noticed.
template <class Variant>
bool takes_place_of(const Variant& newer, const Variant& older) {
  if (newer.index() != older.index()) return false;
  return std::visit(
      [&older](const auto& one) {
        using Message = std::decay_t<decltype(one)>;
        constexpr bool kHasText = std::is_same_v<Message, OrderMessage> ||
                                  std::is_same_v<Message, StateMessage> ||
                                  std::is_same_v<Message, TroubleMessage>;
        if constexpr (kHasSender<Message>) return std::get<Message>(older).sender == one.sender;
        return !kHasText;
      },
      newer);
}
inline bool takes_place_of(const WorldEnd::Received& newer, const WorldEnd::Received& older) {
  return newer.robot == older.robot && takes_place_of(newer.message, older.message);
}
/// States and troubles are all kept.
inline bool takes_place_of(const OperatorEnd::Received&, const OperatorEnd::Received&) {
  return false;
}

/// Messages that arrived and were not yet taken, oldest first. Any thread puts messages, one thread
/// takes them.
template <class Message>
class Inbox {
 public:
  explicit Inbox(Keep keep) : keep_(keep) {}

  void put(Message message) {
    {
      const std::lock_guard lock(mutex_);
      if (keep_ == Keep::Newest) {
        const auto old = std::find_if(
            messages_.begin(), messages_.end(),
            [&message](const Message& waiting) { return takes_place_of(message, waiting); });
        if (old != messages_.end()) messages_.erase(old);
      }
      messages_.push_back(std::move(message));
    }
    came_.notify_one();
  }

  /// Takes the oldest message; waits for one until `until`.
  std::optional<Message> take(TimePoint until) {
    std::unique_lock lock(mutex_);
    came_.wait_until(lock, until, [this] { return !messages_.empty(); });
    if (messages_.empty()) return std::nullopt;
    std::optional<Message> oldest(std::move(messages_.front()));
    messages_.pop_front();
    return oldest;
  }

 private:
  Keep keep_;
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Message> messages_;
};

}  // namespace swarmsmith
