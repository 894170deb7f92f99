#include "coordinator/coordinator.h"

#include <algorithm>

#include "base/assert.h"
#include "base/overloaded.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kArenaBytes = 256U << 10U;
constexpr std::size_t kMaxFaults = 10'000;

google::protobuf::ArenaOptions arena_options() {
  google::protobuf::ArenaOptions options;
  options.start_block_size = kArenaBytes;
  options.max_block_size = kArenaBytes;
  return options;
}

}  // namespace

Coordinator::Coordinator(CoordinatorOptions options, WorkSource& source,
                         std::span<const StoredScore> known)
    : options_(std::move(options)),
      facts_{.campaign_digest = options_.campaign_digest,
             .scenario = options_.scenario,
             .scenario_digest = digest_of_scenario(options_.scenario)},
      source_(&source),
      scheduler_(options_.scheduler, known),
      arena_(arena_options()) {}

void Coordinator::send(PeerId peer, std::string frame) {
  actions_.emplace_back(SendFrame{peer, std::move(frame)});
}

// --- frames ---

bool Coordinator::is_refused(PeerId peer, TimePoint now) {
  if (faults_.empty()) return false;
  const auto fault = faults_.find(peer);
  if (fault == faults_.end() || fault->second.count < options_.malformed_limit) return false;
  if (now < fault->second.refused_until) return true;
  faults_.erase(fault);
  return false;
}

void Coordinator::on_malformed(PeerId peer, const Error& error, TimePoint now) {
  ++malformed_[error.where];
  ++malformed_count_;
  if (error.kind == ErrorKind::Conflict) {
    send(peer, frame_of(SendReject{peer, 0, RejectReason::Protocol, error.message}));
  }
  // Connections come and go; the memory of their faults is bounded.
  if (faults_.size() >= kMaxFaults) faults_.clear();
  Fault& fault = faults_[peer];
  if (++fault.count < options_.malformed_limit) return;
  fault.refused_until = now + options_.refuse_for;
  own_rows_.emplace_back(EventRow{
      .severity = "warning",
      .kind = "peer refused",
      .text = event_text({{"frames", std::int64_t{fault.count}}, {"last", error.message}})});
  scheduler_.on_refused(peer, now);
}

void Coordinator::on_frame(PeerId peer, std::string_view frame, TimePoint now) {
  if (is_refused(peer, now)) {
    ++malformed_count_;
    return;
  }
  const Expected<const pb::ToCoordinator*> message = decode_to_coordinator(frame, arena_);
  if (message) {
    on_message(peer, **message, now);
  } else {
    on_malformed(peer, message.error(), now);
  }
  arena_.Reset();
}

void Coordinator::on_message(PeerId peer, const pb::ToCoordinator& message, TimePoint now) {
  const Sender sender{peer, message.incarnation(), message.sequence()};
  switch (message.body_case()) {
    case pb::ToCoordinator::kHello:
      scheduler_.on_hello(
          peer, hello_of(message.hello(), message.incarnation(), facts_.scenario_digest), now);
      return;
    case pb::ToCoordinator::kCredit:
      scheduler_.on_credit(sender, message.credit().tasks(), now);
      return;
    case pb::ToCoordinator::kResults:
      on_results(sender, message.results(), now);
      return;
    case pb::ToCoordinator::kHeartbeat:
      running_of(message.heartbeat(), running_);
      scheduler_.on_heartbeat(sender, message.heartbeat().credit(), running_, now);
      return;
    case pb::ToCoordinator::kReturned:
      scheduler_.on_returned(sender, keys_of(message.returned()), now);
      return;
    case pb::ToCoordinator::kGoodbye:
      scheduler_.on_goodbye(sender, now);
      return;
    case pb::ToCoordinator::kWantScenario:
      if (scheduler_.on_sign_of_life(sender, now)) {
        send(peer, scenario_reply_of(facts_, sender.incarnation));
      }
      return;
    case pb::ToCoordinator::BODY_NOT_SET:
      scheduler_.on_sign_of_life(sender, now);
      return;
  }
}

void Coordinator::on_results(const Sender& sender, const pb::Results& results, TimePoint now) {
  // Of another campaign that ran here before: nobody wants them.
  if (results.scenario() != facts_.scenario_digest) {
    on_malformed(sender.peer, {ErrorKind::BadInput, "results of another campaign", "campaign"},
                 now);
    return;
  }
  results_of(results, results_);
  scheduler_.on_results(sender, results_, now);
}

void Coordinator::on_unreachable(PeerId peer, TimePoint now) {
  faults_.erase(peer);
  scheduler_.on_unreachable(peer, now);
}

void Coordinator::on_cut_off(PeerId peer, TimePoint now) {
  faults_.erase(peer);
  scheduler_.on_refused(peer, now);
}

void Coordinator::on_tick(TimePoint now) {
  scheduler_.on_tick(now);
}

// --- actions ---

void Coordinator::carry_out(SchedulerAction& action) {
  std::visit(
      Overloaded{
          [&](const SendWelcome& a) { send(a.peer, frame_of(a, facts_, options_.scheduler)); },
          [&](const SendReject& a) { send(a.peer, frame_of(a)); },
          [&](const SendTasks& a) {
            send(a.peer, frame_of(a, facts_, arena_));
            arena_.Reset();
          },
          [&](const SendAcknowledged& a) {
            send(a.peer, acknowledgement_of(a.keys, a.incarnation));
          },
          [&](const SendHeartbeat& a) { send(a.peer, frame_of(a)); },
          [&](const SendWhoAreYou& a) { send(a.peer, frame_of(a)); },
          [&](const SendDrain& a) { send(a.peer, frame_of(a)); },
          [&](const OutcomeAccepted& a) {
            waiting_[pack(a.outcome.key)].first = a.outcome.worker;
            source_->tell(a.outcome);
          },
          [&](const OutcomeRepeated& a) { repeat(a); },
          [&](const ConflictFound& a) { own_rows_.emplace_back(a.row); },
          [&](WorkerChanged& a) { own_rows_.emplace_back(std::move(a.row)); },
          [&](FailureKept& a) { own_rows_.emplace_back(std::move(a.row)); },
          [&](Noted& a) { own_rows_.emplace_back(std::move(a.row)); },
          [&](StopCampaign& a) {
            if (!stopped_) stopped_ = std::move(a.reason);
          },
      },
      action);
}

/// On disk already: acknowledged now. Else with the first copy.
void Coordinator::repeat(const OutcomeRepeated& action) {
  const auto at = waiting_.find(action.key);
  if (at == waiting_.end()) {
    acknowledge({{action.worker, {action.key}}});
    return;
  }
  Waiting& waiting = at->second;
  if (waiting.first == action.worker || std::ranges::count(waiting.others, action.worker) > 0) {
    return;
  }
  waiting.others.push_back(action.worker);
}

void Coordinator::acknowledge(const std::map<WorkerNumber, std::vector<PackedKey>>& keys) {
  for (const auto& [number, all] : keys) {
    const WorkerEntry* worker = scheduler_.connected_worker(number);
    if (worker == nullptr) continue;
    for (std::size_t at = 0; at < all.size(); at += kMaxItemsPerMessage) {
      const std::span<const PackedKey> some(
          all.data() + at, std::min<std::size_t>(kMaxItemsPerMessage, all.size() - at));
      send(worker->peer, acknowledgement_of(some, worker->hello.incarnation));
    }
  }
}

bool Coordinator::progress() {
  std::vector<SchedulerAction> actions = scheduler_.take_actions();
  for (SchedulerAction& action : actions)
    carry_out(action);
  std::vector<Task> tasks = source_->take_tasks();
  const bool more = !actions.empty() || !tasks.empty();
  if (!tasks.empty()) scheduler_.add(std::move(tasks));
  return more;
}

void Coordinator::append() {
  std::vector<Row> rows = source_->take_rows();
  rows.insert(rows.end(), std::make_move_iterator(own_rows_.begin()),
              std::make_move_iterator(own_rows_.end()));
  own_rows_.clear();
  if (rows.empty()) return;
  std::vector<PackedKey> keys;
  for (const Row& row : rows) {
    if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) {
      keys.push_back(pack(evaluation->key));
    }
  }
  unappended_.push_back(std::move(keys));
  actions_.emplace_back(AppendRows{std::move(rows)});
}

std::vector<CoordinatorAction> Coordinator::take_actions(TimePoint now) {
  do {
    while (progress()) {
    }
    scheduler_.dispatch(now);
  } while (progress());
  append();
  return std::exchange(actions_, {});
}

void Coordinator::on_appended(std::uint64_t ticket) {
  SWARMSMITH_ASSERT(!unappended_.empty(), "a ticket belongs to rows that were given out");
  SWARMSMITH_ASSERT(appended_.empty() || appended_.back().first < ticket, "tickets count up");
  appended_.emplace_back(ticket, std::move(unappended_.front()));
  unappended_.pop_front();
}

void Coordinator::on_committed(std::uint64_t ticket) {
  std::map<WorkerNumber, std::vector<PackedKey>> keys;
  while (!appended_.empty() && appended_.front().first <= ticket) {
    for (const PackedKey key : appended_.front().second) {
      const auto at = waiting_.find(key);
      if (at == waiting_.end()) continue;
      keys[at->second.first].push_back(key);
      for (const WorkerNumber other : at->second.others)
        keys[other].push_back(key);
      waiting_.erase(at);
    }
    appended_.pop_front();
  }
  acknowledge(keys);
}

LiveStatus Coordinator::status() const {
  const SchedulerCounters& counters = scheduler_.counters();
  const auto count = [](auto number) { return static_cast<std::int64_t>(number); };
  return {.workers = count(scheduler_.workers().connected()),
          .slots = scheduler_.workers().slots(),
          .ready = count(scheduler_.leases().queued()),
          .leased = count(scheduler_.leases().leased()),
          .done = count(counters.done),
          .rejected = count(counters.rejected),
          .failed = count(counters.failed),
          .requeued = count(counters.requeued),
          .duplicates = count(counters.duplicates),
          .conflicts = count(counters.conflicts),
          .malformed = count(malformed_count_),
          .uncommitted = count(waiting_.size()),
          .evaluations_per_s = 0,
          .trouble = {},
          .insecure_plaintext = false,
          .refused = {}};
}

}  // namespace swarmsmith
