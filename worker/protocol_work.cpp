#include "worker/protocol.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "proto/task_messages.h"
#include "proto/wire.pb.h"

// The part of the protocol that handles work: tasks in, results out, credit for more.

namespace swarmsmith {

void WorkerProtocol::on_tasks(const pb::Tasks& tasks, TimePoint now) {
  if (state_ != State::Active || !has_scenario_ || tasks.scenario() != scenario_) return;
  RunItems run;
  std::vector<PackedKey> refused;
  for (const pb::Task& task : tasks.tasks()) {
    const std::optional<PackedKey> packed = pack(task.key());
    SWARMSMITH_ASSERT(packed, "keys are checked where a frame is read");
    const PackedKey key = *packed;
    if (const auto finished = finished_.find(key); finished != finished_.end()) {
      Result& known = finished->second.result;
      const bool again = !known.failure.empty() && task.attempt() > known.attempt;
      if (!again) {
        if (known.failure.empty()) {
          known.signature = task.signature();
          known.attempt = task.attempt();
        }
        queue_result(key, finished->second, now);
        continue;
      }
      finished_.erase(finished);
    }
    if (drain_until_) {
      refused.push_back(key);
      continue;
    }
    const auto [held, is_new] = held_.try_emplace(key);
    held->second.attempt = task.attempt();
    held->second.signature = task.signature();
    if (!is_new) continue;
    if (task.alone()) {
      announce(task_of(task), now);
    } else {
      run.items.push_back(task_of(task));
    }
  }
  if (!run.items.empty()) actions_.emplace_back(std::move(run));
  if (!refused.empty()) on_taken_back(refused, now);
}

void WorkerProtocol::announce(LeasedTask item, TimePoint now) {
  pb::ToCoordinator message;
  unpack(item.key, *message.mutable_began()->mutable_key());
  send(message, now);
  announced_.emplace_back(now + options_.before_alone, std::move(item));
}

void WorkerProtocol::begin_alone(TimePoint now) {
  RunItems run;
  std::erase_if(announced_, [&](auto& each) {
    const bool is_due = now >= each.first;
    if (is_due) run.items.push_back(std::move(each.second));
    return is_due;
  });
  if (!run.items.empty()) actions_.emplace_back(std::move(run));
}

void WorkerProtocol::on_started(PackedKey key, TimePoint now) {
  const auto held = held_.find(key);
  if (held != held_.end()) held->second.started = now;
}

void WorkerProtocol::on_evaluated(Result result, TimePoint now) {
  const PackedKey key = result.key;
  const auto held = held_.find(key);
  if (held == held_.end()) return;  // belongs to a campaign that is over
  // A signal that ends this worker also ends its programs: the evaluation did not fail.
  if (drain_until_ && !result.failure.empty()) return on_taken_back({&key, 1}, now);
  // The values of its latest lease: it may have been leased to this worker again in the meantime.
  result.attempt = held->second.attempt;
  result.signature = held->second.signature;
  SWARMSMITH_ASSERT(result.measured.wall_us >= 0, "slots measure by a clock that never goes back");
  count_busy(held->second, result.measured.wall_us, now);
  held_.erase(held);
  const auto spent_us = static_cast<double>(result.measured.wall_us);
  estimate_us_ += (estimate_us_ == 0 ? 1.0 : 0.05) * (spent_us - estimate_us_);
  Finished& finished = finished_[key];
  finished = Finished{std::move(result), false, {}};
  queue_result(key, finished, now);
  if (must_flush(now)) flush(now);
  if (drain_until_) finish_draining(now);
}

void WorkerProtocol::queue_result(PackedKey key, Finished& finished, TimePoint now) {
  SWARMSMITH_ASSERT(finished_.contains(key), "a result is kept until it is acknowledged");
  if (finished.queued) return;
  finished.queued = true;
  if (unsent_.empty()) oldest_unsent_ = now;
  unsent_.push_back(key);
}

/// Early enough before the slots run out of work, and at the latest after `flush_after`.
bool WorkerProtocol::must_flush(TimePoint now) const {
  return unsent_.size() >= options_.results_per_message ||
         held_.size() <= static_cast<std::size_t>(identity_.slots) || drain_until_ ||
         now - oldest_unsent_ >= options_.flush_after;
}

void WorkerProtocol::flush(TimePoint now) {
  if (state_ != State::Active || unsent_.empty()) return;
  const std::vector<PackedKey> keys = std::exchange(unsent_, {});
  const std::span<const PackedKey> all(keys);
  for (std::size_t at = 0; at < all.size(); at += options_.results_per_message) {
    send_results(all.subspan(at, std::min(options_.results_per_message, all.size() - at)), now);
  }
  update_credit(now);
}

void WorkerProtocol::send_results(std::span<const PackedKey> keys, TimePoint now) {
  SWARMSMITH_ASSERT(keys.size() <= options_.results_per_message, "a message has a limit");
  auto& message = *google::protobuf::Arena::CreateMessage<pb::ToCoordinator>(&arena_);
  pb::Results& results = *message.mutable_results();
  results.set_scenario(scenario_);
  for (const PackedKey key : keys) {
    const auto at = finished_.find(key);
    if (at == finished_.end()) continue;
    at->second.queued = false;
    at->second.sent = now;
    sent_.emplace_back(now, key);
    write(at->second.result, *results.add_results());
  }
  if (results.results_size() > 0) send(message, now);
}

/// What was not acknowledged may never have come (orchestration facts, 5 "Acknowledged after the
/// commit").
void WorkerProtocol::resend(TimePoint now) {
  while (!sent_.empty() && now - sent_.front().first >= resend_after_) {
    const auto [when, key] = sent_.front();
    sent_.pop_front();
    const auto finished = finished_.find(key);
    if (finished == finished_.end() || finished->second.sent != when) continue;
    queue_result(key, finished->second, now);
  }
}

void WorkerProtocol::on_taken_back(std::span<const PackedKey> keys, TimePoint now) {
  for (std::size_t at = 0; at < keys.size(); at += kMaxItemsPerMessage) {
    pb::ToCoordinator message;
    for (const PackedKey key :
         keys.subspan(at, std::min<std::size_t>(kMaxItemsPerMessage, keys.size() - at))) {
      held_.erase(key);
      unpack(key, *message.mutable_returned()->add_keys());
    }
    if (state_ == State::Active) send(message, now);
  }
  if (drain_until_) finish_draining(now);
}

/// Two tasks per slot, plus the number of tasks that fit in `work_ahead`
/// (orchestration facts, 5 "Credit").
std::uint32_t WorkerProtocol::credit() const {
  if (drain_until_ || !has_scenario_ || finished_.size() > options_.max_unacknowledged) return 0;
  const double ahead_us = std::chrono::duration<double, std::micro>(options_.work_ahead).count();
  const double a_slot = 2.0 + (estimate_us_ > 0 ? std::min(ahead_us / estimate_us_, 1e6) : 0.0);
  return static_cast<std::uint32_t>(
      std::min(a_slot * identity_.slots, static_cast<double>(max_credit_)));
}

/// Sends the credit if it has changed considerably; small changes wait for the heartbeat.
void WorkerProtocol::update_credit(TimePoint now) {
  if (state_ != State::Active) return;
  const std::uint32_t wanted = credit();
  const bool same = 4 * wanted <= 5 * credit_sent_ && 5 * wanted >= 4 * credit_sent_;
  if (same) return;
  credit_sent_ = wanted;
  pb::ToCoordinator message;
  message.mutable_credit()->set_tasks(wanted);
  send(message, now);
}

/// Counts the part of an evaluation after the welcome, because slot time is per connection.
void WorkerProtocol::count_busy(const Held& held, std::int64_t wall_us, TimePoint now) {
  const Duration spent =
      wall_us > 0 ? Duration(std::chrono::microseconds(wall_us)) : now - held.started.value_or(now);
  busy_ += std::min(spent, now - welcomed_);
}

void WorkerProtocol::heartbeat(TimePoint now) {
  last_beat_ = now;
  pb::ToCoordinator message;
  pb::Heartbeat& beat = *message.mutable_heartbeat();
  credit_sent_ = credit();
  beat.set_credit(credit_sent_);
  beat.set_held(static_cast<std::uint32_t>(held_.size()));
  Duration busy = busy_;
  for (const auto& [key, held] : held_) {
    if (!held.started) continue;
    busy += now - std::max(*held.started, welcomed_);
    if (beat.running_size() >= kMaxItemsPerMessage) continue;
    pb::Running& running = *beat.add_running();
    unpack(key, *running.mutable_key());
    const auto elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(now - *held.started);
    running.set_elapsed_ms(std::max<std::int64_t>(0, elapsed.count()));
  }
  const auto us = [](Duration time) {
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::microseconds>(time).count());
  };
  const std::uint64_t slot_us = us(identity_.slots * (now - welcomed_));
  beat.set_slot_us(slot_us);
  // Slots report the end of an evaluation slightly late: the sum with those that have begun since
  // must not exceed the slots' time.
  beat.set_busy_us(std::min(us(busy), slot_us));
  send(message, now);
}

}  // namespace swarmsmith
