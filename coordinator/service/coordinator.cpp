#include "coordinator/service/coordinator.h"

#include <algorithm>

#include "base/assert.h"
#include "base/overloaded.h"
#include "coordinator/pool/event_text.h"
#include "coordinator/service/paused_designs.h"
#include "proto/wire.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kArenaBytes = 256U << 10U;

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
      budgets_(options_.budgets),
      scheduler_(options_.scheduler),
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
          [&](const SendWhoAreYou& a) { send(a.peer, frame_of(a)); },
          [&](const SendDrain& a) { send(a.peer, frame_of(a)); },
          [&](const OutcomeAccepted& a) {
            name_worker(a.outcome.worker);
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
            if (!may_name(a.row.other_worker, "conflict", kConflictBytes, now)) return;
            campaigns_[a.campaign].own_rows.emplace_back(a.row);
          },
          [&](const WorkerChanged& a) { put_worker(a.row, now); },
          [&](FailureKept& a) {
            // Why a program failed is never left out: its worker is believed, and people look
            // there.
            const bool is_due = options_.scheduler.evaluates_programs;
            if (!is_due && !may_name(a.row.worker, "failure", bytes_of(a.row), now)) return;
            name_worker(a.row.worker);
            campaigns_[a.campaign].own_rows.emplace_back(std::move(a.row));
          },
          [&](AttemptEnded& a) {
            if (!may_name(a.row.worker, "attempt", kAttemptBytes, now)) return;
            campaigns_[a.campaign].own_rows.emplace_back(std::move(a.row));
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
  put_rows(budgets_.take_news(now, true));
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

/// Brings stored scores before the referee that an earlier process chose. Their designs are opened
/// one after the other, so one is looked at a time, and all when the campaign is over: what cannot
/// be told any more is of a design that has ended.
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
      EventRow{.severity = "warning",
               .kind = "audits left out; `swarmsmith verify --sample` makes evaluations again",
               .text = event_text({{"evaluations", static_cast<std::int64_t>(words.size())}})});
  words.clear();
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

std::vector<CoordinatorAction> Coordinator::take_actions(TimePoint now) {
  scheduler_.on_time(now);
  do {
    while (progress(now)) {
    }
    scheduler_.dispatch(now);
  } while (progress(now));
  // Once: what this leaves idle is filled when something happens.
  if (look_ahead()) {
    do {
      scheduler_.dispatch(now);
    } while (progress(now));
  }
  if (sample_due_) {
    write_late_workers(now);
    put_rows(budgets_.take_news(now));
  }
  for (std::uint32_t index = 0; index < campaigns_.size(); ++index) {
    append(index);
    const Campaign& campaign = campaigns_[index];
    const bool on_disk = campaign.unappended.empty() && campaign.appended.empty();
    scheduler_.close(index, on_disk && campaign.source->finished());
  }
  pool_rows_.clear();
  // After leasing: slots that are about to be given work are no idle ones.
  if (std::exchange(sample_due_, false)) slots_.sample(scheduler_, holding_, now);
  return std::exchange(actions_, {});
}

}  // namespace swarmsmith
