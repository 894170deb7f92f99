#include "coordinator/coordinator.h"

#include <algorithm>
#include <iterator>

#include "base/assert.h"
#include "base/overloaded.h"
#include "coordinator/paused_designs.h"
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

Coordinator::Coordinator(CoordinatorOptions options, const std::vector<CampaignWork>& campaigns)
    : options_(std::move(options)),
      facts_{.campaign_digests = {},
             .scenario = options_.scenario,
             .scenario_digest = digest_of_scenario(options_.scenario)},
      scheduler_(options_.scheduler),
      arena_(arena_options()) {
  SWARMSMITH_ASSERT(campaigns.size() == options_.scheduler.campaigns.size(),
                    "each campaign has a policy");
  for (const CampaignWork& campaign : campaigns) {
    const auto index = static_cast<std::uint32_t>(campaigns_.size());
    close_ended(index, *campaign.source);
    scheduler_.know(index, campaign.known);
    facts_.campaign_digests.push_back(campaign.digest);
    campaigns_.push_back({.source = campaign.source, .paused = paused_designs(campaign.commands)});
    if (!campaign.commands.empty()) campaigns_.back().commands = campaign.commands.back().number;
    for (const DesignId design : campaigns_.back().paused)
      scheduler_.hold_design(index, design.value, true);
  }
}

bool Coordinator::settled() const {
  return waiting_.empty() && std::ranges::all_of(campaigns_, [](const Campaign& campaign) {
           return campaign.unappended.empty() && campaign.appended.empty();
         });
}

bool Coordinator::finished() const {
  const bool done = std::ranges::all_of(campaigns_, [](const Campaign& campaign) {
    return campaign.stopped || campaign.source->finished();
  });
  return done && settled() && !scheduler_.is_auditing();
}

void Coordinator::put_row(const Row& row) {
  pool_rows_.push_back(row);
}

void Coordinator::send(PeerId peer, std::string frame) {
  actions_.emplace_back(SendFrame{peer, std::move(frame), {}});
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
  put_row(EventRow{
      .severity = "warning",
      .kind = "peer refused",
      .text = event_text({{"frames", std::int64_t{fault.count}}, {"last", error.message}})});
  scheduler_.on_refused(peer, now);
}

void Coordinator::on_frame(const Peer& peer, std::string_view frame, TimePoint now) {
  if (is_refused(peer.id, now)) {
    ++malformed_count_;
    return;
  }
  const Expected<const pb::ToCoordinator*> message = decode_to_coordinator(frame, arena_);
  if (message) {
    on_message(peer, **message, now);
  } else {
    on_malformed(peer.id, message.error(), now);
  }
  arena_.Reset();
}

void Coordinator::on_message(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  const auto forbidden = [&] {
    on_malformed(peer.id,
                 {ErrorKind::BadInput,
                  "the key \"" + std::string(peer.client) + "\" does not allow this", "role"},
                 now);
  };
  if (message.has_command()) {
    return may_command(peer.role) ? on_command(peer, message.command()) : forbidden();
  }
  if (message.has_want_status()) {
    if (!may_read(peer.role)) return forbidden();
    actions_.emplace_back(AnswerStatus{peer.id});
    return;
  }
  return may_work(peer.role) ? on_work(peer, message, now) : forbidden();
}

void Coordinator::on_work(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  const Sender sender{peer.id, message.incarnation(), message.sequence()};
  switch (message.body_case()) {
    case pb::ToCoordinator::kHello: {
      WorkerHello hello = hello_of(message.hello(), message.incarnation(), facts_.scenario_digest);
      hello.client = peer.client;
      scheduler_.on_hello(peer.id, std::move(hello), now);
      return;
    }
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
        send(peer.id, scenario_reply_of(facts_, sender.incarnation));
      }
      return;
    case pb::ToCoordinator::kCommand:
    case pb::ToCoordinator::kWantStatus:
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

void Coordinator::on_unreachable(const SendFrame& unsent, TimePoint now) {
  faults_.erase(unsent.peer);
  scheduler_.on_unreachable(unsent.peer, now, unsent.leases);
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
            std::vector<PackedKey> leases;
            for (const SendTasks::Leased& leased : a.tasks)
              leases.push_back(key_of(leased.task));
            actions_.emplace_back(
                SendFrame{a.peer, frame_of(a, facts_, arena_), std::move(leases)});
            arena_.Reset();
          },
          [&](const SendAcknowledged& a) {
            send(a.peer, acknowledgement_of(a.keys, a.incarnation));
          },
          [&](const SendHeartbeat& a) { send(a.peer, frame_of(a)); },
          [&](const SendWhoAreYou& a) { send(a.peer, frame_of(a)); },
          [&](const SendDrain& a) { send(a.peer, frame_of(a)); },
          [&](const OutcomeAccepted& a) {
            waiting_[key_of(a.outcome)].first = a.outcome.worker;
            Campaign& campaign = campaigns_[a.outcome.campaign];
            campaign.source->tell(a.outcome);
            campaign.told = true;
            campaign.sees_no_further = false;
          },
          [&](const OutcomeRepeated& a) { repeat(a); },
          [&](const ConflictFound& a) { campaigns_[a.campaign].own_rows.emplace_back(a.row); },
          [&](const WorkerChanged& a) { put_row(a.row); },
          [&](FailureKept& a) { campaigns_[a.campaign].own_rows.emplace_back(std::move(a.row)); },
          [&](AttemptEnded& a) { campaigns_[a.campaign].own_rows.emplace_back(std::move(a.row)); },
          [&](Noted& a) {
            if (!a.campaign) return put_row(a.row);
            campaigns_[*a.campaign].own_rows.emplace_back(std::move(a.row));
          },
          [&](StopCampaign& a) {
            Campaign& campaign = campaigns_[a.campaign];
            if (!campaign.stopped) campaign.stopped = std::move(a.reason);
            scheduler_.forget(a.campaign);
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

void Coordinator::close_ended(std::uint32_t index, WorkSource& source) {
  for (const DesignId design : source.take_ended())
    scheduler_.close_design(index, design);
}

bool Coordinator::progress() {
  std::vector<SchedulerAction> actions = scheduler_.take_actions();
  for (SchedulerAction& action : actions)
    carry_out(action);
  bool more = !actions.empty();
  for (std::uint32_t index = 0; index < campaigns_.size(); ++index) {
    Campaign& campaign = campaigns_[index];
    if (campaign.stopped) continue;
    if (const std::optional<Error> error = campaign.source->error()) {
      campaign.stopped = to_string(*error);
      scheduler_.forget(index);
      continue;
    }
    std::vector<Task> tasks = campaign.source->take_tasks();
    if (!tasks.empty()) {
      for (Task& task : tasks)
        task.campaign = index;
      scheduler_.add(std::move(tasks));
      more = true;
    }
    if (!std::exchange(campaign.told, false)) continue;
    std::vector<PackedKey> dropped;
    for (const EvaluationKey& key : campaign.source->take_dropped())
      dropped.push_back(pack(key, index));
    scheduler_.drop(dropped);
    close_ended(index, *campaign.source);
  }
  return more;
}

/// Asks the campaigns in turn for work for slots that would idle. False when there is none.
bool Coordinator::look_ahead() {
  std::size_t idle = scheduler_.idle_slots();
  const auto slots = static_cast<std::size_t>(scheduler_.workers().slots());
  bool any = false;
  for (std::size_t asked = 0; asked < campaigns_.size() && idle > 0; ++asked) {
    const auto index = static_cast<std::uint32_t>(ahead_turn_);
    ahead_turn_ = (ahead_turn_ + 1) % campaigns_.size();
    Campaign& campaign = campaigns_[index];
    if (campaign.stopped || campaign.sees_no_further || scheduler_.is_held(index)) continue;
    std::vector<Task> tasks = campaign.source->take_more(idle, slots);
    campaign.sees_no_further = tasks.empty();
    if (tasks.empty()) continue;
    idle -= std::min(idle, tasks.size());
    for (Task& task : tasks)
      task.campaign = index;
    scheduler_.add(std::move(tasks));
    any = true;
  }
  return any;
}

void Coordinator::append(std::uint32_t index) {
  Campaign& campaign = campaigns_[index];
  std::vector<Row> rows = campaign.source->take_rows();
  note_if_all_is_paused(campaign);
  rows.insert(rows.end(), std::make_move_iterator(campaign.own_rows.begin()),
              std::make_move_iterator(campaign.own_rows.end()));
  campaign.own_rows.clear();
  rows.insert(rows.end(), pool_rows_.begin(), pool_rows_.end());
  std::vector<SendFrame> replies = std::exchange(campaign.replies, {});
  if (rows.empty()) {
    std::ranges::move(replies, std::back_inserter(actions_));
    return;
  }
  Unit unit{.replies = std::move(replies)};
  for (const Row& row : rows) {
    if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) {
      unit.keys.push_back(pack(evaluation->key, index));
    }
  }
  campaign.unappended.push_back(std::move(unit));
  actions_.emplace_back(AppendRows{index, std::move(rows), pool_rows_.size()});
}

std::vector<CoordinatorAction> Coordinator::take_actions(TimePoint now) {
  do {
    while (progress()) {
    }
    scheduler_.dispatch(now);
  } while (progress());
  // Once: what this leaves idle is filled when something happens.
  if (look_ahead()) {
    do {
      scheduler_.dispatch(now);
    } while (progress());
  }
  for (std::uint32_t index = 0; index < campaigns_.size(); ++index) {
    append(index);
    const Campaign& campaign = campaigns_[index];
    const bool on_disk = campaign.unappended.empty() && campaign.appended.empty();
    scheduler_.close(index, on_disk && campaign.source->finished());
  }
  pool_rows_.clear();
  return std::exchange(actions_, {});
}

void Coordinator::on_appended(std::uint32_t index, std::uint64_t ticket) {
  Campaign& campaign = campaigns_[index];
  SWARMSMITH_ASSERT(!campaign.unappended.empty(), "a ticket belongs to rows that were given out");
  SWARMSMITH_ASSERT(campaign.appended.empty() || campaign.appended.back().ticket < ticket,
                    "tickets count up");
  campaign.appended.push_back(std::move(campaign.unappended.front()));
  campaign.appended.back().ticket = ticket;
  campaign.unappended.pop_front();
}

void Coordinator::on_committed(std::uint32_t index, std::uint64_t ticket) {
  std::deque<Unit>& appended = campaigns_[index].appended;
  std::map<WorkerNumber, std::vector<PackedKey>> keys;
  while (!appended.empty() && appended.front().ticket <= ticket) {
    for (const PackedKey key : appended.front().keys) {
      const auto at = waiting_.find(key);
      if (at == waiting_.end()) continue;
      keys[at->second.first].push_back(key);
      for (const WorkerNumber other : at->second.others)
        keys[other].push_back(key);
      waiting_.erase(at);
    }
    std::ranges::move(appended.front().replies, std::back_inserter(actions_));
    appended.pop_front();
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
          .expired = count(counters.expired),
          .lost_workers = count(counters.lost_workers),
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
