#include "coordinator/service/coordinator.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/assert.h"
#include "base/overloaded.h"
#include "base/plain_text.h"
#include "coordinator/pool/event_text.h"
#include "coordinator/service/paused_designs.h"
#include "proto/task_messages.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"

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

/// A scenario with pictures takes megabytes, so only one copy is kept.
PoolFacts facts_of(std::string scenario) {
  const std::uint64_t digest = digest_of_scenario(scenario);
  return {.campaign_digests = {}, .scenario = std::move(scenario), .scenario_digest = digest};
}

}  // namespace

Coordinator::Coordinator(CoordinatorOptions options, const std::vector<CampaignWork>& campaigns)
    : options_(std::move(options)),
      facts_(facts_of(std::move(options_.scenario))),
      budgets_(options_.budgets),
      scheduler_(options_.scheduler),
      pool_rows_(scheduler_, budgets_),
      arena_(arena_options()) {
  SWARMSMITH_ASSERT(campaigns.size() == options_.scheduler.campaigns.size(),
                    "each campaign has a policy");
  for (const CampaignWork& campaign : campaigns) {
    const auto index = static_cast<std::uint32_t>(campaigns_.size());
    close_ended(index, *campaign.source);
    facts_.campaign_digests.push_back(campaign.digest);
    campaigns_.push_back({.source = campaign.source,
                          .paused = paused_designs(campaign.commands),
                          .unaudited = scheduler_.know(index, campaign.known, campaign.trust)});
    if (!campaign.commands.empty()) campaigns_.back().commands = campaign.commands.back().number;
    for (const DesignId design : campaigns_.back().paused)
      scheduler_.hold_design(index, design.value, true);
  }
}

// Messages from peers: which peer may send what, and which peers are refused.

bool Coordinator::is_refused(PeerId peer, TimePoint now) {
  if (faults_.empty()) return false;
  const auto fault = faults_.find(peer);
  if (fault == faults_.end() || fault->second.count < options_.malformed_limit) return false;
  if (now < fault->second.refused_until) return true;
  faults_.erase(fault);
  return false;
}

void Coordinator::on_malformed(const Peer& peer, const Error& error, TimePoint now) {
  ++malformed_[error.where];
  ++malformed_count_;
  if (error.kind == ErrorKind::Conflict) {
    send(peer.id, frame_of(SendReject{peer.id, 0, RejectReason::Protocol, error.message}));
  }
  // Connections come and go, so the memory for their faults has a limit.
  if (faults_.size() >= kMaxFaults) faults_.clear();
  Fault& fault = faults_[peer.id];
  if (++fault.count < options_.malformed_limit) return;
  fault.refused_until = now + options_.refuse_for;
  Noted noted{.campaign = std::nullopt,
              .row = pool_event("warning", "peer refused",
                                {{"frames", std::int64_t{fault.count}}, {"last", error.message}}),
              .source = principal_of(WorkerHello{.client = std::string(peer.client),
                                                 .address = std::string(peer.address)})};
  put_event(noted, now);
  scheduler_.on_refused(peer.id, now);
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
    on_malformed(peer, message.error(), now);
  }
  arena_.Reset();
}

void Coordinator::on_message(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  const auto forbidden = [&] {
    const std::string sentence = "the key \"" + std::string(peer.client) + "\" has a role that " +
                                 "does not allow this; `role` in clients.toml says which it is";
    // A client whose key is listed gets the reason; unknown clients never get this far.
    send(peer.id,
         frame_of(SendReject{peer.id, message.incarnation(), RejectReason::Protocol, sentence}));
    on_malformed(peer, {ErrorKind::BadInput, sentence, "role"}, now);
  };
  if (message.has_command()) {
    return may_command(peer.role) ? on_command(peer, message.command(), now) : forbidden();
  }
  if (message.has_want_status()) {
    if (!may_read(peer.role)) return forbidden();
    if (budgets_.may_be_sent(peer.id, 0, now)) actions_.emplace_back(AnswerStatus{peer.id});
    return;
  }
  return may_work(peer.role) ? on_work(peer, message, now) : forbidden();
}

void Coordinator::on_work(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  const Sender sender{peer.id, message.incarnation(), message.sequence()};
  switch (message.body_case()) {
    case pb::ToCoordinator::kHello:
      on_hello(peer, message, now);
      return;
    case pb::ToCoordinator::kCredit:
      scheduler_.on_credit(sender, message.credit().tasks(), now);
      return;
    case pb::ToCoordinator::kResults:
      on_results(peer, message, now);
      return;
    case pb::ToCoordinator::kHeartbeat:
      running_of(message.heartbeat(), running_);
      scheduler_.on_heartbeat(sender, message.heartbeat().credit(), running_, now,
                              slots_of(message.heartbeat()));
      return;
    case pb::ToCoordinator::kReturned:
      scheduler_.on_returned(sender, keys_of(message.returned()), now);
      return;
    case pb::ToCoordinator::kBegan:
      scheduler_.on_began(sender, *pack(message.began().key()), now);
      return;
    case pb::ToCoordinator::kGoodbye:
      scheduler_.on_goodbye(sender, now);
      return;
    case pb::ToCoordinator::kWantScenario:
      // A worker repeats its request.
      if (scheduler_.on_sign_of_life(sender, now) &&
          budgets_.may_be_sent(peer.id, facts_.scenario.size(), now)) {
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

/// A worker whose hello was not answered sends it again, on another connection.
void Coordinator::on_hello(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  const bool is_local = same_secret(message.hello().secret(), options_.local_secret);
  if (!is_local) {
    const std::string name = principal_of(
        WorkerHello{.client = std::string(peer.client), .address = std::string(peer.address)});
    const Principal* known = scheduler_.principals().find(name);
    const Source source{name, known == nullptr || known->is_stranger()};
    if (!budgets_.may_say_hello(peer.id, source, now)) return;
  }
  WorkerHello hello = hello_of(message.hello(), message.incarnation(), facts_.scenario_digest);
  hello.client = peer.client;
  hello.address = peer.address;
  hello.local = is_local;
  scheduler_.on_hello(peer.id, std::move(hello), now);
}

void Coordinator::on_results(const Peer& peer, const pb::ToCoordinator& message, TimePoint now) {
  // Results of a campaign that ran here earlier are not needed.
  if (message.results().scenario() != facts_.scenario_digest) {
    on_malformed(peer, {ErrorKind::BadInput, "results of another campaign", "campaign"}, now);
    return;
  }
  results_of(message.results(), results_);
  scheduler_.on_results({peer.id, message.incarnation(), message.sequence()}, results_, now);
}

void Coordinator::on_unreachable(const SendFrame& unsent) {
  std::vector<PackedKey>& leases = unreachable_[unsent.peer];
  leases.insert(leases.end(), unsent.leases.begin(), unsent.leases.end());
}

void Coordinator::on_all_read(TimePoint now) {
  for (const auto& [peer, leases] : std::exchange(unreachable_, {})) {
    faults_.erase(peer);
    scheduler_.on_unreachable(peer, now, leases);
  }
}

void Coordinator::on_cut_off(PeerId peer, TimePoint now) {
  faults_.erase(peer);
  scheduler_.on_refused(peer, now);
}

void Coordinator::on_tick(TimePoint now) {
  scheduler_.on_tick(now);
  sample_due_ = true;
}

// Commands of people to running campaigns. A command is stored as a row, and the client gets its
// answer when the row is on disk: a confirmed command survives a crash.

void Coordinator::on_command(const Peer& peer, const pb::Command& command, TimePoint now) {
  if (!budgets_.may_command(now)) {
    budgets_.leave_out("command");
    return send(peer.id, command_reply_of(false, "too many commands at once: ask again later"));
  }
  const bool is_of_pool = command_kind_of(command.kind()) == CommandKind::Forgive;
  const Expected<std::uint32_t> index =
      is_of_pool ? Expected<std::uint32_t>(0U) : campaign_of(command);
  const Expected<std::string> done = !index       ? Expected<std::string>(Unexpected(index.error()))
                                     : is_of_pool ? forgive(command, now)
                                                  : obey(*index, command);
  std::string frame = command_reply_of(done.has_value(), done ? *done : to_string(done.error()));
  if (!done) return send(peer.id, std::move(frame));
  campaigns_[*index].replies.push_back({peer.id, std::move(frame)});
}

Expected<std::uint32_t> Coordinator::campaign_of(const pb::Command& command) const {
  if (command.campaign().empty()) {
    if (campaigns_.size() == 1) return 0U;
    return bad_input("this coordinator runs " + std::to_string(campaigns_.size()) +
                     " campaigns: name the store of one");
  }
  const auto at = std::ranges::find(facts_.campaign_digests, command.campaign());
  if (at == facts_.campaign_digests.end()) {
    return unexpected(ErrorKind::NotFound, "this coordinator does not run the campaign",
                      command.campaign());
  }
  return static_cast<std::uint32_t>(at - facts_.campaign_digests.begin());
}

Expected<std::string> Coordinator::obey(std::uint32_t index, const pb::Command& command) {
  Campaign& campaign = campaigns_[index];
  const CommandRow row{.number = campaign.commands + 1,
                       .kind = command_kind_of(command.kind()),
                       .design = {command.design()},
                       .budget = command.budget(),
                       .who = command.who()};
  if (row.kind == CommandKind::Unknown) return bad_input("unknown command");
  if (campaign.stopped) return bad_input("the campaign has stopped: " + *campaign.stopped);
  if (is_of_leases(row.kind)) return pause(index, row);
  if (auto done = campaign.source->carry_out(row); !done) return Unexpected(done.error());
  ++campaign.commands;
  // A cancelled design drops its tasks, and an extended one has work to look ahead at again.
  campaign.told = true;
  campaign.sees_no_further = false;
  const std::string name = to_string(row.design);
  if (row.kind == CommandKind::Cancel) return name + " is cancelled";
  return name + " gets " + counted(row.budget, "experiment") + " more";
}

/// A command to the pool: every store gets the rows, and the answer waits for the first commit.
Expected<std::string> Coordinator::forgive(const pb::Command& command, TimePoint now) {
  const std::vector<std::string> names = scheduler_.forgive(command.whom(), command.who(), now);
  if (!names.empty()) return sentence_of_forgiven(names);
  std::vector<std::string> known;
  for (const QuarantineStatus& one : quarantine(now))
    known.push_back(one.who);
  return not_in_quarantine(command.whom(), known);
}

/// Pauses or resumes designs; repeating a command changes nothing. Evaluations that are already
/// running finish, and count.
Expected<std::string> Coordinator::pause(std::uint32_t index, const CommandRow& command) {
  Campaign& campaign = campaigns_[index];
  const std::vector<DesignId> unfinished = campaign.source->unfinished();
  auto rows = rows_of_pause(command, unfinished, campaign.paused);
  if (!rows) {
    return unexpected(
        ErrorKind::NotFound,
        "the campaign has no such design, or it is over; unfinished designs: " + listed(unfinished),
        to_string(command.design));
  }
  for (CommandRow& row : *rows) {
    row.number = ++campaign.commands;
    apply_pause(row, campaign.paused);
    scheduler_.hold_design(index, row.design.value, row.kind == CommandKind::Pause);
    campaign.own_rows.emplace_back(row);
  }
  return sentence_of_pause(command.kind, *rows);
}

/// Reports once that all designs of a campaign are paused, so that it waits for a person.
void Coordinator::note_if_all_is_paused(Campaign& campaign) {
  bool all = !campaign.paused.empty() && !campaign.stopped;
  if (all) {
    const std::vector<DesignId> left = campaign.source->unfinished();
    all = !left.empty() && std::ranges::all_of(left, [&](DesignId design) {
      return campaign.paused.contains(design);
    });
    if (all && !campaign.all_paused) {
      campaign.own_rows.emplace_back(
          pool_event("warning", "only paused designs remain; `swarmsmith resume` continues them",
                     {{"designs", listed(left)}}));
    }
  }
  campaign.all_paused = all;
}

// Decisions of the scheduler, and work that the campaigns want.

bool Coordinator::finished() const {
  const bool done = std::ranges::all_of(campaigns_, [](const Campaign& campaign) {
    return campaign.stopped || (campaign.source->finished() && campaign.unaudited.empty());
  });
  return done && settled() && !scheduler_.is_auditing();
}

void Coordinator::send(PeerId peer, std::string frame) {
  actions_.emplace_back(SendFrame{peer, std::move(frame), {}});
}

void Coordinator::carry_out(SchedulerAction& action, TimePoint now) {
  std::visit(
      Overloaded{
          [&](const SendWelcome& a) { send(a.peer, frame_of(a, facts_, options_.scheduler)); },
          [&](const SendReject& a) { send(a.peer, frame_of(a)); },
          [&](const SendTasks& a) {
            std::vector<PackedKey> leases;
            for (const LeasedTask& task : a.tasks)
              leases.push_back(task.key);
            actions_.emplace_back(
                SendFrame{a.peer, frame_of(a, facts_, arena_), std::move(leases)});
            arena_.Reset();
          },
          [&](const SendAcknowledged& a) {
            send(a.peer, acknowledgement_of(a.keys, a.incarnation));
          },
          [&](const SendHeartbeat& a) { send(a.peer, frame_of(a)); },
          [&](const SendNotice& a) { send(a.peer, frame_of(a)); },
          [&](const Forgiven& a) { pool_rows_.put_forgiven(a.principal); },
          [&](const SendWhoAreYou& a) { send(a.peer, frame_of(a)); },
          [&](const SendDrain& a) { send(a.peer, frame_of(a)); },
          [&](const OutcomeAccepted& a) {
            pool_rows_.name_worker(a.outcome.worker);
            waiting_[key_of(a.outcome)].first = a.outcome.worker;
            Campaign& campaign = campaigns_[a.outcome.campaign];
            campaign.source->tell(a.outcome);
            campaign.told = true;
            campaign.sees_no_further = false;
          },
          [&](const OutcomeRepeated& a) { repeat(a); },
          [&](const TaskInDispute& a) {
            std::optional<Task> task = campaigns_[a.campaign].source->task_of(a.key);
            if (task) task->campaign = a.campaign;
            scheduler_.on_disputed(pack(a.key, a.campaign), task, now);
          },
          [&](const ConflictFound& a) {
            if (!pool_rows_.may_name(a.row.other_worker, "conflict", kConflictBytes, now)) return;
            campaigns_[a.campaign].own_rows.emplace_back(a.row);
          },
          [&](const WorkerChanged& a) { pool_rows_.put_worker(a.row, now); },
          [&](FailureKept& a) {
            // The reason why a program failed is never left out: its worker is trusted, and people
            // look for the reason there.
            const bool is_due = options_.scheduler.evaluates_programs;
            if (!is_due && !pool_rows_.may_name(a.row.worker, "failure", bytes_of(a.row), now))
              return;
            pool_rows_.name_worker(a.row.worker);
            campaigns_[a.campaign].own_rows.emplace_back(std::move(a.row));
          },
          [&](AttemptEnded& a) {
            if (!pool_rows_.may_name(a.row.worker, "attempt", kAttemptBytes, now)) return;
            campaigns_[a.campaign].own_rows.emplace_back(a.row);
          },
          [&](Noted& a) { put_event(a, now); },
          [&](StopCampaign& a) {
            Campaign& campaign = campaigns_[a.campaign];
            if (!campaign.stopped) campaign.stopped = std::move(a.reason);
            campaign.distrusted |= a.distrusted;
            if (a.distrusted) campaign.own_rows.emplace_back(CampaignStateRow{"distrusted"});
            scheduler_.forget(a.campaign);
          },
          [&](AskReferee& a) { actions_.emplace_back(std::move(a)); },
      },
      action);
}

void Coordinator::drain(TimePoint now) {
  scheduler_.drain(now);
  put_news(now, true);
}

void Coordinator::close_ended(std::uint32_t index, WorkSource& source) {
  for (const DesignId design : source.take_ended())
    scheduler_.close_design(index, design);
  for (const PassedCandidates& passed : source.take_passed())
    scheduler_.close_candidates(index, passed);
}

bool Coordinator::progress(TimePoint now) {
  std::vector<SchedulerAction> actions = scheduler_.take_actions();
  for (SchedulerAction& action : actions)
    carry_out(action, now);
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
    audit_stored(index);
    if (!std::exchange(campaign.told, false)) continue;
    std::vector<PackedKey> dropped;
    for (const EvaluationKey& key : campaign.source->take_dropped())
      dropped.push_back(pack(key, index));
    scheduler_.drop(dropped);
    close_ended(index, *campaign.source);
  }
  return more;
}

/// Sends the stored scores to the referee that an earlier process chose for an audit. Designs are
/// opened one after another, so each call looks at one score, or at all of them when the campaign
/// is over: a score that cannot be found even then belongs to a design that has ended.
void Coordinator::audit_stored(std::uint32_t index) {
  Campaign& campaign = campaigns_[index];
  std::deque<StoredWord>& words = campaign.unaudited;
  const bool is_over = campaign.source->finished();
  for (std::size_t left = is_over ? words.size() : std::min<std::size_t>(words.size(), 1); left > 0;
       --left) {
    StoredWord word = std::move(words.front());
    words.pop_front();
    std::optional<Task> task = campaign.source->task_of(word.key);
    if (!task) {
      words.push_back(std::move(word));
      continue;
    }
    task->campaign = index;
    scheduler_.audit_stored(std::move(*task), std::move(word.said));
  }
  if (!is_over || words.empty()) return;
  campaign.own_rows.emplace_back(
      pool_event("warning", "audits skipped; `swarmsmith verify --sample` repeats evaluations",
                 {{"evaluations", static_cast<std::int64_t>(words.size())}}));
  words.clear();
}

/// Asks the campaigns in turn for look-ahead work for idle slots. Returns false if there is none.
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

std::vector<CoordinatorAction> Coordinator::take_actions(TimePoint now) {
  scheduler_.on_time(now);
  // Leases make messages, and outcomes make new tasks, so both are repeated until nothing changes.
  do {
    while (progress(now)) {
    }
    scheduler_.dispatch(now);
  } while (progress(now));
  // Only once: slots that stay idle now are filled when something happens.
  if (look_ahead()) {
    do {
      scheduler_.dispatch(now);
    } while (progress(now));
  }
  if (sample_due_) {
    pool_rows_.write_late_workers(now);
    put_news(now);
  }
  for (std::uint32_t index = 0; index < campaigns_.size(); ++index) {
    append(index);
    const Campaign& campaign = campaigns_[index];
    const bool on_disk = campaign.unappended.empty() && campaign.appended.empty();
    scheduler_.close(index, on_disk && campaign.source->finished());
  }
  pool_rows_.clear();
  // After leasing, so that slots that are about to get work do not count as idle.
  if (std::exchange(sample_due_, false)) slots_.sample(scheduler_, holding_, now);
  return std::exchange(actions_, {});
}

// Outcomes: rows for the stores, tickets, and acknowledgements once everything is on disk.

void Coordinator::put_event(Noted& noted, TimePoint now) {
  if (!pool_rows_.may_note(noted, now)) return;
  if (!noted.campaign) return pool_rows_.put(std::move(noted.row));
  campaigns_[*noted.campaign].own_rows.emplace_back(std::move(noted.row));
}

/// Events about messages and rows that were left out because they were over budget.
void Coordinator::put_news(TimePoint now, bool now_or_never) {
  for (EventRow& row : budgets_.take_news(now, now_or_never))
    pool_rows_.put(std::move(row));
}

void Coordinator::append(std::uint32_t index) {
  Campaign& campaign = campaigns_[index];
  std::vector<Row> rows = campaign.source->take_rows();
  note_if_all_is_paused(campaign);
  rows.insert(rows.end(), std::make_move_iterator(campaign.own_rows.begin()),
              std::make_move_iterator(campaign.own_rows.end()));
  campaign.own_rows.clear();
  // Each store names the workers of its evaluations, so each gets the pool's rows. They are last,
  // so that the caller can tell them apart by their number.
  rows.insert(rows.end(), pool_rows_.rows().begin(), pool_rows_.rows().end());
  std::vector<SendFrame> replies = std::exchange(campaign.replies, {});
  if (rows.empty()) {
    for (SendFrame& reply : replies)
      actions_.emplace_back(std::move(reply));
    return;
  }
  Unit unit{.replies = std::move(replies)};
  for (const Row& row : rows) {
    if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) {
      unit.keys.push_back(pack(evaluation->key, index));
    }
  }
  campaign.unappended.push_back(std::move(unit));
  actions_.emplace_back(AppendRows{index, std::move(rows), pool_rows_.rows().size()});
}

void Coordinator::on_appended(std::uint32_t index, std::uint64_t ticket) {
  Campaign& campaign = campaigns_[index];
  SWARMSMITH_ASSERT(!campaign.unappended.empty(),
                    "a ticket belongs to rows that were sent to the store");
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
      // A row comes again when a race uses a score that was made ahead. It was acknowledged with
      // its first row.
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

/// Acknowledges a repeated outcome at once if it is on disk, else together with the first copy.
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

bool Coordinator::settled() const {
  return waiting_.empty() && std::ranges::all_of(campaigns_, [](const Campaign& campaign) {
           return campaign.unappended.empty() && campaign.appended.empty();
         });
}

}  // namespace swarmsmith
