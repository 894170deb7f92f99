#include "worker/protocol.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "proto/task_messages.h"
#include "proto/wire.pb.h"

namespace swarmsmith {
namespace {

/// A request that gets no answer is repeated: the coordinator limits the rate of scenarios, and
/// drops requests beyond it (docs/security.md, "Budgets").
constexpr Duration kAskAgain = std::chrono::seconds(1);

}  // namespace

WorkerProtocol::WorkerProtocol(WorkerIdentity identity, WorkerOptions options, Rng jitter)
    : identity_(std::move(identity)),
      options_(options),
      jitter_(jitter),
      backoff_(options_.first_backoff) {
  SWARMSMITH_ASSERT(identity_.slots >= 1, "a worker evaluates something");
  SWARMSMITH_ASSERT(options_.first_backoff <= options_.longest_backoff, "pauses grow");
  SWARMSMITH_ASSERT(options_.results_per_message >= 1 &&
                        options_.results_per_message <= std::size_t{kMaxItemsPerMessage},
                    "a message has a result, and no more than the wire takes");
}

std::vector<WorkerAction> WorkerProtocol::take_actions() {
  return std::exchange(actions_, {});
}

void WorkerProtocol::start(TimePoint now) {
  SWARMSMITH_ASSERT(state_ == State::Waiting && incarnation_ == 0, "a worker starts once");
  alone_since_ = now;
  ticked_ = now;
  greet(now);
}

// --- the connection ---

void WorkerProtocol::send(pb::ToCoordinator& message, TimePoint) {
  SWARMSMITH_ASSERT(state_ == State::Greeting || state_ == State::Active,
                    "messages go over a connection that is there");
  // The coordinator ignores credit of an earlier hello, and credit that is older than the last one
  // (docs/protocol.md, "What happens when a message is lost, doubled or late").
  message.set_incarnation(incarnation_);
  message.set_sequence(++sequence_);
  actions_.emplace_back(SendToCoordinator{encode(message)});
}

/// Opens a connection, unless the coordinator asked for a greeting on the existing one.
void WorkerProtocol::greet(TimePoint now) {
  SWARMSMITH_ASSERT(state_ != State::Left, "a worker that has left stays away");
  if (state_ == State::Waiting) actions_.emplace_back(OpenConnection{});
  // Time without a coordinator begins when it asks who this worker is: it does not know it any
  // more.
  if (state_ == State::Active) alone_since_ = now;
  state_ = State::Greeting;
  greeted_ = now;
  ++incarnation_;
  sequence_ = 0;
  pb::ToCoordinator message;
  pb::Hello& hello = *message.mutable_hello();
  hello.set_worker_id(identity_.id);
  hello.set_build(clipped_text(identity_.build, kMaxNameBytes));
  hello.set_engine_version(identity_.engine_version);
  hello.set_self_test(identity_.self_test);
  hello.set_slots(static_cast<std::uint32_t>(identity_.slots));
  hello.set_host(clipped_text(identity_.host, kMaxNameBytes));
  hello.set_pid(identity_.pid);
  hello.set_job(clipped_text(identity_.job, kMaxNameBytes));
  hello.set_cpu(clipped_text(identity_.cpu, kMaxNameBytes));
  hello.set_secret(identity_.secret);
  hello.set_scenario(scenario_);
  // The coordinator keeps the leases of these tasks, and leases the others again. The signatures
  // prove them to a coordinator that was restarted (decision 19).
  for (const auto& [key, held] : held_) {
    if (hello.holds_size() >= kMaxItemsPerMessage) break;
    unpack(key, *hello.add_holds());
    hello.add_attempts(held.attempt);
    hello.add_signatures(held.signature);
  }
  send(message, now);
}

void WorkerProtocol::on_connection_lost(TimePoint now) {
  if (state_ == State::Greeting || state_ == State::Active) lose(now);
}

void WorkerProtocol::lose(TimePoint now) {
  SWARMSMITH_ASSERT(state_ == State::Greeting || state_ == State::Active, "there is one to lose");
  if (state_ == State::Active) alone_since_ = now;
  state_ = State::Waiting;
  // Random, so that a thousand workers do not all reconnect at the same time
  // (orchestration facts, 5 "A worker alone").
  const double factor = jitter_.uniform(0.5, 1.5);
  retry_ =
      now + Duration(static_cast<std::int64_t>(factor * static_cast<double>(backoff_.count())));
  backoff_ = std::min(2 * backoff_, options_.longest_backoff);
  if (drain_until_) leave(WorkerExit::Done, "drained without a connection");
}

void WorkerProtocol::leave(WorkerExit code, const std::string& reason) {
  if (state_ == State::Left) return;
  state_ = State::Left;
  actions_.emplace_back(Leave{code, reason});
}

void WorkerProtocol::on_frame(std::string_view frame, TimePoint now) {
  // A message of a connection that was given up.
  if (state_ == State::Left || state_ == State::Waiting) return;
  const Expected<const pb::ToWorker*> message = decode_to_worker(frame, arena_);
  if (message) {
    handle(**message, now);
    // Another major version: no later message can be understood either. Other frames that cannot be
    // read are dropped.
  } else if (message.error().kind == ErrorKind::Conflict) {
    leave(WorkerExit::Refused, message.error().message);
  }
  arena_.Reset();
}

void WorkerProtocol::handle(const pb::ToWorker& message, TimePoint now) {
  // Ignores messages for earlier incarnations, but not acknowledgements: those results are on disk.
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
      for (const pb::Key& wanted : message.acknowledged().keys()) {
        const std::optional<PackedKey> key = pack(wanted);
        SWARMSMITH_ASSERT(key, "keys are checked where a frame is read");
        finished_.erase(*key);
      }
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
    case pb::ToWorker::kNotice:
      if (current) actions_.emplace_back(Say{message.notice().sentence()});
      return;
    case pb::ToWorker::kHeartbeat:
    // Messages for other clients.
    case pb::ToWorker::kCommandReply:
    case pb::ToWorker::kStatusReply:
    case pb::ToWorker::BODY_NOT_SET:
      return;
  }
}

void WorkerProtocol::on_reject(const pb::Reject& reject) {
  const bool for_now = reject.reason() == pb::Reject::REASON_LIMIT;
  leave(for_now ? WorkerExit::NoPlace : WorkerExit::Refused, reject.sentence());
}

void WorkerProtocol::on_welcome(const pb::Welcome& welcome, TimePoint now) {
  if (state_ != State::Greeting) return;
  state_ = State::Active;
  // Only after a welcome: a coordinator that accepts connections and does not answer is asked at
  // growing intervals, too.
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
  // Credit of the last incarnation is void, so it is sent again.
  credit_sent_ = 0;
  // A key contains the position of a campaign in the scenario's list, so in another scenario the
  // same key is another evaluation.
  if (welcome.scenario() != scenario_) {
    scenario_ = welcome.scenario();
    has_scenario_ = false;
    held_.clear();
    announced_.clear();
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
  // Orchestration facts, 5 "Scenario by digest". It is requested again after kAskAgain.
  if (digest_of_scenario(reply.scenario()) != scenario_) return;
  has_scenario_ = true;
  actions_.emplace_back(UseScenario{reply.scenario()});
  be_ready(now);
}

void WorkerProtocol::on_bad_scenario(const std::string& reason) {
  leave(WorkerExit::Refused, "this program cannot run the campaign: " + reason);
}

/// Connected, with a scenario: sends results that the coordinator may not have, asks for work.
void WorkerProtocol::be_ready(TimePoint now) {
  SWARMSMITH_ASSERT(state_ == State::Active && has_scenario_, "work follows welcome and scenario");
  // Acknowledgements of the last connection may be lost. A result that comes twice does no harm.
  for (auto& [key, finished] : finished_)
    queue_result(key, finished, now);
  flush(now);
  update_credit(now);
}

// --- the end ---

void WorkerProtocol::on_drain(TimePoint now) {
  if (drain_until_ || state_ == State::Left) return;
  drain_until_ = now + options_.grace;
  if (state_ == State::Waiting) return leave(WorkerExit::Done, "drained without a connection");
  // The coordinator may have received the hello already.
  if (state_ == State::Greeting) return say_goodbye(now, "drained without a welcome");
  update_credit(now);
  // Tasks that have not started go back at once, so that others can evaluate them during the grace
  // time.
  actions_.emplace_back(TakeBack{});
  std::vector<PackedKey> announced;
  for (const auto& [when, item] : std::exchange(announced_, {}))
    announced.push_back(item.key);
  if (!announced.empty()) on_taken_back(announced, now);
  flush(now);
}

/// Leaves when nothing runs and all results are on the coordinator's disk, or the time is up
/// (orchestration facts, 5 "Drain").
void WorkerProtocol::finish_draining(TimePoint now) {
  if (state_ != State::Active) return;
  SWARMSMITH_ASSERT(drain_until_, "only a worker that drains finishes draining");
  flush(now);
  const bool late = now >= *drain_until_;
  if (!late && !(held_.empty() && finished_.empty())) return;
  std::vector<PackedKey> rest;
  for (const auto& [key, held] : held_)
    rest.push_back(key);
  held_.clear();
  // Otherwise `on_taken_back` would call this function again.
  drain_until_.reset();
  if (!rest.empty()) on_taken_back(rest, now);
  say_goodbye(now, "drained");
}

/// With it the coordinator counts this worker as one that left, and otherwise as lost
/// (docs/protocol.md, "A worker's life").
void WorkerProtocol::say_goodbye(TimePoint now, const std::string& reason) {
  pb::ToCoordinator message;
  message.mutable_goodbye();
  send(message, now);
  leave(WorkerExit::Done, reason);
}

// --- time ---

void WorkerProtocol::on_tick(TimePoint now) {
  // This process was stopped or got no processor time, so it could not receive anything:
  // silence is measured by its clock (orchestration facts, 5 "Heartbeats, both ways").
  if (now - ticked_ > dead_after_ / 2) last_heard_ = now;
  ticked_ = now;
  // Also without a connection: slots go on with the tasks that they have.
  if (state_ != State::Left) begin_alone(now);
  switch (state_) {
    case State::Left:
      return;
    case State::Waiting:
      if (now - alone_since_ > options_.give_up_after) {
        leave(WorkerExit::Unreachable, "no coordinator for too long");
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
  // The transport reports a closed connection; silence shows a host or a link that is dead, or a
  // coordinator that hangs (orchestration facts, 5 "Heartbeats, both ways").
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
  TimePoint next = next_of_state();
  for (const auto& [when, item] : announced_)
    next = std::min(next, when);
  return next;
}

TimePoint WorkerProtocol::next_of_state() const {
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
