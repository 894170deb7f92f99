#include "worker/protocol.h"

#include <algorithm>
#include <utility>

namespace swarmsmith {
namespace {

constexpr Duration kAskAgain = std::chrono::seconds(1);

std::string clipped(const std::string& text) {
  return text.substr(0, kMaxTextBytes);
}

}  // namespace

WorkerProtocol::WorkerProtocol(WorkerIdentity identity, WorkerOptions options, Rng jitter)
    : identity_(std::move(identity)),
      options_(options),
      jitter_(jitter),
      backoff_(options_.first_backoff) {}

std::vector<WorkerAction> WorkerProtocol::take_actions() {
  return std::exchange(actions_, {});
}

void WorkerProtocol::start(TimePoint now) {
  alone_since_ = now;
  ticked_ = now;
  greet(now);
}

// --- the connection ---

void WorkerProtocol::send(pb::ToCoordinator& message, TimePoint) {
  message.set_incarnation(incarnation_);
  message.set_sequence(++sequence_);
  actions_.emplace_back(SendToCoordinator{encode(message)});
}

/// Opens a connection, unless it was asked for on the one that there is.
void WorkerProtocol::greet(TimePoint now) {
  if (state_ == State::Waiting) actions_.emplace_back(OpenConnection{});
  if (state_ == State::Active) alone_since_ = now;
  state_ = State::Greeting;
  greeted_ = now;
  ++incarnation_;
  sequence_ = 0;
  pb::ToCoordinator message;
  pb::Hello& hello = *message.mutable_hello();
  hello.set_worker_id(identity_.id);
  hello.set_build(clipped(identity_.build));
  hello.set_engine_version(identity_.engine_version);
  hello.set_self_test(identity_.self_test);
  hello.set_slots(static_cast<std::uint32_t>(identity_.slots));
  hello.set_host(clipped(identity_.host));
  hello.set_pid(identity_.pid);
  hello.set_job(clipped(identity_.job));
  hello.set_cpu(clipped(identity_.cpu));
  hello.set_scenario(scenario_);
  for (const auto& [key, held] : held_) {
    if (hello.holds_size() >= kMaxItemsPerMessage) break;
    unpack(key, *hello.add_holds());
  }
  send(message, now);
}

void WorkerProtocol::on_connection_lost(TimePoint now) {
  if (state_ == State::Greeting || state_ == State::Active) lose(now);
}

void WorkerProtocol::lose(TimePoint now) {
  if (state_ == State::Active) alone_since_ = now;
  state_ = State::Waiting;
  // Jitter, so that a thousand workers do not come back in step.
  const double factor = jitter_.uniform(0.5, 1.5);
  retry_ =
      now + Duration(static_cast<std::int64_t>(factor * static_cast<double>(backoff_.count())));
  backoff_ = std::min(2 * backoff_, options_.longest_backoff);
  if (drain_until_) leave(ExitCode::Done, "drained without a connection");
}

void WorkerProtocol::leave(ExitCode code, const std::string& reason) {
  if (state_ == State::Left) return;
  state_ = State::Left;
  actions_.emplace_back(Leave{code, reason});
}

void WorkerProtocol::on_frame(std::string_view frame, TimePoint now) {
  if (state_ == State::Left || state_ == State::Waiting) return;
  const Expected<const pb::ToWorker*> message = decode_to_worker(frame, arena_);
  if (message) {
    handle(**message, now);
  } else if (message.error().kind == ErrorKind::Conflict) {
    leave(ExitCode::Refused, message.error().message);
  }
  arena_.Reset();
}

void WorkerProtocol::handle(const pb::ToWorker& message, TimePoint now) {
  // Words meant for an earlier incarnation are void, but what is on disk stays there.
  const bool current = message.incarnation() == incarnation_;
  if (current) last_heard_ = now;
  switch (message.body_case()) {
    case pb::ToWorker::kWelcome:
      if (current) on_welcome(message.welcome(), now);
      return;
    case pb::ToWorker::kReject:
      if (current || message.incarnation() == 0) on_reject(message.reject());
      return;
    case pb::ToWorker::kTasks:
      if (current) on_tasks(message.tasks(), now);
      return;
    case pb::ToWorker::kAcknowledged:
      for (const pb::Key& key : message.acknowledged().keys())
        finished_.erase(*pack(key));
      return;
    case pb::ToWorker::kScenario:
      if (current) on_scenario(message.scenario(), now);
      return;
    case pb::ToWorker::kDrain:
      if (current) on_drain(now);
      return;
    case pb::ToWorker::kWhoAreYou:
      if (state_ == State::Active) greet(now);
      return;
    case pb::ToWorker::kHeartbeat:
    // For people's programs.
    case pb::ToWorker::kCommandReply:
    case pb::ToWorker::kStatusReply:
    case pb::ToWorker::BODY_NOT_SET:
      return;
  }
}

void WorkerProtocol::on_reject(const pb::Reject& reject) {
  leave(ExitCode::Refused, reject.sentence());
}

void WorkerProtocol::on_welcome(const pb::Welcome& welcome, TimePoint now) {
  if (state_ != State::Greeting) return;
  state_ = State::Active;
  backoff_ = options_.first_backoff;
  last_heard_ = now;
  last_beat_ = now;
  welcomed_ = now;
  busy_ = Duration{0};
  const auto or_default = [](std::int64_t ms, Duration fallback) {
    return ms > 0 ? Duration(std::chrono::milliseconds(ms)) : fallback;
  };
  heartbeat_ = or_default(welcome.heartbeat_ms(), heartbeat_);
  dead_after_ = or_default(welcome.dead_after_ms(), dead_after_);
  resend_after_ = or_default(welcome.resend_ms(), resend_after_);
  max_credit_ = std::min<std::uint32_t>(welcome.max_credit(), kMaxItemsPerMessage);
  credit_sent_ = 0;
  if (welcome.scenario() != scenario_) {
    scenario_ = welcome.scenario();
    has_scenario_ = false;
    held_.clear();
    finished_.clear();
    unsent_.clear();
    sent_.clear();
    actions_.emplace_back(DropItems{});
  }
  if (has_scenario_) {
    be_ready(now);
  } else {
    asked_ = now;
    pb::ToCoordinator message;
    message.mutable_want_scenario();
    send(message, now);
  }
}

void WorkerProtocol::on_scenario(const pb::ScenarioReply& reply, TimePoint now) {
  if (has_scenario_ || state_ != State::Active) return;
  if (digest_of_scenario(reply.scenario()) != scenario_) return;
  has_scenario_ = true;
  actions_.emplace_back(UseScenario{reply.scenario()});
  be_ready(now);
}

void WorkerProtocol::on_bad_scenario(const std::string& reason) {
  leave(ExitCode::Refused, "this program cannot run the campaign: " + reason);
}

/// Connected, with a scenario: what the coordinator may not have is sent, and work asked for.
void WorkerProtocol::be_ready(TimePoint now) {
  for (auto& [key, finished] : finished_)
    queue_result(key, finished, now);
  flush(now);
  update_credit(now);
}

// --- the work ---

void WorkerProtocol::on_tasks(const pb::Tasks& tasks, TimePoint now) {
  if (state_ != State::Active || !has_scenario_ || tasks.scenario() != scenario_) return;
  RunItems run;
  std::vector<PackedKey> refused;
  for (const pb::Task& task : tasks.tasks()) {
    const PackedKey key = *pack(task.key());
    if (const auto finished = finished_.find(key); finished != finished_.end()) {
      const Evaluated& known = finished->second.evaluated;
      const bool again = !known.failure.empty() && task.attempt() > known.attempt;
      if (!again) {
        queue_result(key, finished->second, now);
        continue;
      }
      finished_.erase(finished);
    }
    if (drain_until_) {
      refused.push_back(key);
      continue;
    }
    const auto [held, is_new] = held_.try_emplace(key, Held{task.attempt(), {}});
    held->second.attempt = task.attempt();
    if (!is_new) continue;
    run.items.push_back({.key = key,
                         .attempt = task.attempt(),
                         .mission = task.mission(),
                         .method = task.method(),
                         .instance = task.instance(),
                         .seed = task.seed(),
                         .machine = task.machine(),
                         .bound = task.bound(),
                         .alive = {task.alive().begin(), task.alive().end()}});
  }
  if (!run.items.empty()) actions_.emplace_back(std::move(run));
  if (!refused.empty()) on_taken_back(refused, now);
}

void WorkerProtocol::on_started(PackedKey key, TimePoint now) {
  const auto held = held_.find(key);
  if (held != held_.end()) held->second.started = now;
}

void WorkerProtocol::on_evaluated(Evaluated evaluated, TimePoint now) {
  const PackedKey key = evaluated.key;
  const auto held = held_.find(key);
  if (held == held_.end()) return;  // of a campaign that is over
  // What ends this worker ends its programs too: such a failure says nothing of the evaluation.
  if (drain_until_ && !evaluated.failure.empty()) return on_taken_back({&key, 1}, now);
  evaluated.attempt = held->second.attempt;
  count_busy(held->second, evaluated.wall_us, now);
  held_.erase(held);
  const auto spent_us = static_cast<double>(evaluated.wall_us);
  estimate_us_ += (estimate_us_ == 0 ? 1.0 : 0.05) * (spent_us - estimate_us_);
  Finished& finished = finished_[key];
  finished = Finished{std::move(evaluated), false, {}};
  queue_result(key, finished, now);
  if (must_flush(now)) flush(now);
  if (drain_until_) finish_draining(now);
}

void WorkerProtocol::queue_result(PackedKey key, Finished& finished, TimePoint now) {
  if (finished.queued) return;
  finished.queued = true;
  if (unsent_.empty()) oldest_unsent_ = now;
  unsent_.push_back(key);
}

/// In good time before the slots run dry, and never later than `flush_after`.
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
  auto& message = *google::protobuf::Arena::CreateMessage<pb::ToCoordinator>(&arena_);
  pb::Results& results = *message.mutable_results();
  results.set_scenario(scenario_);
  for (const PackedKey key : keys) {
    const auto at = finished_.find(key);
    if (at == finished_.end()) continue;
    at->second.queued = false;
    at->second.sent = now;
    sent_.emplace_back(now, key);
    const Evaluated& evaluated = at->second.evaluated;
    pb::Result& out = *results.add_results();
    unpack(key, *out.mutable_key());
    out.set_attempt(evaluated.attempt);
    out.set_score(evaluated.score);
    out.set_state_digest(evaluated.state_digest);
    out.set_wall_us(evaluated.wall_us);
    out.set_time(evaluated.time);
    out.set_rejected(evaluated.rejected);
    if (evaluated.failure.empty()) continue;
    out.set_failure(clipped(evaluated.failure));
    out.set_command(clipped(evaluated.details.command));
    out.set_output(clipped(evaluated.details.output));
    out.set_errors(clipped(evaluated.details.errors));
  }
  if (results.results_size() > 0) send(message, now);
}

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

/// Two tasks a slot, and what `work_ahead` amounts to.
std::uint32_t WorkerProtocol::credit() const {
  if (drain_until_ || !has_scenario_ || finished_.size() > options_.max_unacknowledged) return 0;
  const double ahead_us = std::chrono::duration<double, std::micro>(options_.work_ahead).count();
  const double a_slot = 2.0 + (estimate_us_ > 0 ? std::min(ahead_us / estimate_us_, 1e6) : 0.0);
  return static_cast<std::uint32_t>(
      std::min(a_slot * identity_.slots, static_cast<double>(max_credit_)));
}

/// Says so when it wants notably more or less; small changes wait for the heartbeat.
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

/// What of an evaluation falls behind the welcome counts: the coordinator asks for this connection.
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
  // Slots tell of an end a little late: what begins meanwhile must not make more than there is.
  beat.set_busy_us(std::min(us(busy), slot_us));
  send(message, now);
}

// --- the end ---

void WorkerProtocol::on_drain(TimePoint now) {
  if (drain_until_ || state_ == State::Left) return;
  drain_until_ = now + options_.grace;
  if (state_ != State::Active) return leave(ExitCode::Done, "drained without a connection");
  update_credit(now);
  actions_.emplace_back(TakeBack{});
  flush(now);
}

/// Leaves when nothing runs and everything is on the coordinator's disk, or the time is over.
void WorkerProtocol::finish_draining(TimePoint now) {
  if (state_ != State::Active) return;
  flush(now);
  const bool late = now >= *drain_until_;
  if (!late && !(held_.empty() && finished_.empty())) return;
  std::vector<PackedKey> rest;
  for (const auto& [key, held] : held_)
    rest.push_back(key);
  held_.clear();
  drain_until_.reset();
  if (!rest.empty()) on_taken_back(rest, now);
  pb::ToCoordinator message;
  message.mutable_goodbye();
  send(message, now);
  leave(ExitCode::Done, "drained");
}

// --- time ---

void WorkerProtocol::on_tick(TimePoint now) {
  // This process was stopped or starved: no wonder that nobody was heard.
  if (now - ticked_ > dead_after_ / 2) last_heard_ = now;
  ticked_ = now;
  switch (state_) {
    case State::Left:
      return;
    case State::Waiting:
      if (now - alone_since_ > options_.give_up_after) {
        leave(ExitCode::Unreachable, "no coordinator for too long");
      } else if (now >= retry_) {
        greet(now);
      }
      return;
    case State::Greeting:
      if (now - greeted_ > options_.welcome_timeout) lose(now);
      return;
    case State::Active:
      break;
  }
  if (now - last_heard_ > dead_after_) return lose(now);
  if (!has_scenario_ && now - asked_ >= kAskAgain) {
    asked_ = now;
    pb::ToCoordinator message;
    message.mutable_want_scenario();
    send(message, now);
  }
  resend(now);
  if (!unsent_.empty() && must_flush(now)) flush(now);
  update_credit(now);
  if (now - last_beat_ >= heartbeat_) heartbeat(now);
  if (drain_until_) finish_draining(now);
}

TimePoint WorkerProtocol::next_deadline() const {
  switch (state_) {
    case State::Left:
      return ticked_;
    case State::Waiting:
      return retry_;
    case State::Greeting:
      return greeted_ + options_.welcome_timeout;
    case State::Active:
      break;
  }
  TimePoint next = last_beat_ + heartbeat_;
  if (!unsent_.empty()) next = std::min(next, oldest_unsent_ + options_.flush_after);
  if (drain_until_) next = std::min(next, *drain_until_);
  return next;
}

}  // namespace swarmsmith
