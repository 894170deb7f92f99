#include "tests/cluster/simulated_cluster.h"

#include <algorithm>

#include "base/overloaded.h"
#include "coordinator/pool/lease_signer.h"
#include "coordinator/pool/task_key.h"
#include "coordinator/service/paused_designs.h"
#include "proto/wire.h"

namespace swarmsmith::cluster {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

CoordinatorOptions coordinator_options(std::int64_t first_worker, std::size_t campaigns,
                                       std::int64_t audit_every) {
  CoordinatorOptions options;
  options.scheduler.campaigns.resize(campaigns);
  options.scheduler.first_worker = first_worker;
  for (CampaignPolicy& policy : options.scheduler.campaigns)
    policy.audit_every = audit_every;
  options.scenario = kScenario;
  // As it is found again after a crash.
  options.scheduler.lease_secret = lease_secret_of("lasting", 1);
  return options;
}

}  // namespace

void SimulatedCluster::start_coordinator() {
  Process& it = coordinator_process_;
  ++it.life;
  it.alive = true;
  it.paused_until = {};
  std::int64_t first_worker = 1;
  std::vector<std::vector<StoredScore>> known;
  std::vector<std::vector<CommandRow>> commands;
  std::vector<CampaignWork> works;
  known.reserve(campaigns_.size());
  commands.reserve(campaigns_.size());
  check_promises();
  for (Running& running : campaigns_) {
    running.disk.open(schedule_.closes_beside);
    running.source = std::make_unique<RacedCampaign>(running.shape, running.disk);
    running.source->watch(running.truths);
    running.tickets = 0;
    running.uncommitted.clear();
    first_worker = std::max(first_worker, running.disk.next_worker());
    known.push_back(running.disk.scores());
    commands.push_back(running.disk.commands());
    works.push_back({.digest = "cluster" + std::to_string(works.size()),
                     .source = running.source.get(),
                     .known = known.back(),
                     .commands = commands.back(),
                     .trust = running.disk.trust()});
  }
  coordinator_ = std::make_unique<Coordinator>(
      coordinator_options(first_worker, campaigns_.size(), schedule_.audit_every), works);
  on_process(kCoordinator, Duration{0}, [this] { tick_coordinator(); });
}

void SimulatedCluster::crash_coordinator() {
  if (!coordinator_process_.alive) return;
  ++crashes_;
  coordinator_process_.alive = false;
  count();
  coordinator_.reset();
  gone_.clear();
  for (Running& running : campaigns_) {
    running.source.reset();
    // Some of what waited for the disk may have come there all the same.
    const bool full = now_ < disk_full_until_;
    const std::uint64_t written = full ? 0 : rng_.below(running.uncommitted.size() + 1);
    for (std::uint64_t i = 0; i < written; ++i)
      write(running, running.uncommitted[i].rows);
    running.uncommitted.clear();
    running.disk.crash();
  }
  cut_strangers_off();
  const bool noticed = rng_.bernoulli(0.7);
  for (int i = 0; i < kWorkers; ++i) {
    Worker& worker = workers_[static_cast<std::size_t>(i)];
    if (worker.connection != 0) connections_[worker.connection].open = false;
    if (!noticed) continue;
    on_process(i, between(Duration{0}, milliseconds(5)), [this, i] {
      workers_[static_cast<std::size_t>(i)].protocol->on_connection_lost(clock(i));
      settle_worker(i);
    });
  }
  at(now_ + between(milliseconds(1), seconds(2)), [this] { start_coordinator(); });
}

void SimulatedCluster::tick_coordinator() {
  coordinator_->on_tick(clock(kCoordinator));
  settle_coordinator();
  on_process(kCoordinator, milliseconds(100), [this] { tick_coordinator(); });
}

void SimulatedCluster::settle_coordinator() {
  for (auto actions = coordinator_->take_actions(clock(kCoordinator));
       !actions.empty() || judge_gone();
       actions = coordinator_->take_actions(clock(kCoordinator))) {
    for (CoordinatorAction& action : actions) {
      std::visit(Overloaded{[&](const SendFrame& send) {
                              if (send.peer == kPerson) return check_confirmed(send.frame);
                              if (!is_stranger(send.peer)) check_acknowledged(send.frame);
                              if (to_worker(send.peer, send.frame) == SendStatus::Gone) {
                                coordinator_->on_unreachable(send);
                                gone_.insert(send.peer);
                              }
                            },
                            [&](AppendRows& rows) { append(rows.campaign, std::move(rows.rows)); },
                            [](const AnswerStatus&) {}, [&](const AskReferee& ask) { judge(ask); }},
                 action);
    }
  }
  check_leases();
  check_trust();
  for (std::uint32_t index = 0; index < campaigns_.size(); ++index) {
    const std::string complaint = campaigns_[index].source->complaint();
    if (!complaint.empty()) fail(complaint);
    if (coordinator_->stopped(index))
      on_stopped(*coordinator_->stopped(index), coordinator_->distrusted(index));
  }
}

/// The coordinator's own child: it knows the truth, and takes some time to find it.
void SimulatedCluster::judge(const AskReferee& ask) {
  const PackedKey key = key_of(ask.task);
  const CampaignShape& shape = campaigns_.at(ask.task.campaign).shape;
  const Truth truth = truth_of(shape, ask.task);
  const bool has_score = truth.kind == Truth::Kind::Score;
  const Ruling ruling{
      .key = key,
      .kind = has_score ? Ruling::Kind::Score : Ruling::Kind::Rejected,
      .measured = {.score = truth.score, .state_digest = truth.state_digest, .wall_us = 1000},
      .reason = has_score ? "" : "planted"};
  on_process(kCoordinator, milliseconds(1), [this, ruling] {
    coordinator_->on_ruling(ruling, clock(kCoordinator));
    settle_coordinator();
  });
}

void SimulatedCluster::append(std::uint32_t campaign, std::vector<Row> rows) {
  Running& running = campaigns_[campaign];
  left_out_audits_ |= std::ranges::any_of(rows, [](const Row& row) {
    const auto* event = std::get_if<EventRow>(&row);
    return event != nullptr && event->kind.starts_with("audits skipped");
  });
  running.uncommitted.push_back({++running.tickets, std::move(rows)});
  coordinator_->on_appended(campaign, running.tickets);
  const bool slow = rng_.bernoulli(schedule_.faults.slow_commit);
  const Duration delay = slow ? between(milliseconds(10), milliseconds(800))
                              : between(microseconds(200), milliseconds(2));
  running.last_commit = std::max(running.last_commit, now_ + delay);
  // The disk goes on while the process is paused, but its word is heard afterwards.
  on_process(kCoordinator, running.last_commit - now_, [this, campaign] { commit(campaign); });
}

void SimulatedCluster::commit(std::uint32_t campaign) {
  Running& running = campaigns_[campaign];
  if (running.uncommitted.empty()) return;
  if (now_ < disk_full_until_) {
    coordinator_->hold(Holding::Other);
    on_process(kCoordinator, disk_full_until_ - now_, [this, campaign] { commit(campaign); });
    return;
  }
  coordinator_->hold(Holding::No);
  const Batch batch = std::move(running.uncommitted.front());
  running.uncommitted.pop_front();
  write(running, batch.rows);
  coordinator_->on_committed(campaign, batch.ticket);
  settle_coordinator();
}

void SimulatedCluster::write(Running& running, const std::vector<Row>& rows) {
  std::vector<Row> kept = rows;
  // Hostile peers give other results, and have them stored as such.
  if (!schedule_.hostile.empty())
    std::erase_if(kept, [](const Row& row) { return std::holds_alternative<ConflictRow>(row); });
  for (const Row& row : kept)
    check_row(running, row);
  if (const std::string complaint = running.disk.commit(kept); !complaint.empty()) fail(complaint);
}

/// Of a coordinator that ends.
void SimulatedCluster::count() {
  const SchedulerCounters& last = coordinator_->scheduler().counters();
  counters_.copies += last.copies;
  counters_.ahead += last.ahead;
  counters_.duplicates += last.duplicates;
  counters_.lost_workers += last.lost_workers;
}

/// Every lease is of a worker that is there, and the counts of tasks, of copies, of designs and of
/// workers are those of the leases.
void SimulatedCluster::check_leases() {
  const LeaseTable& leases = coordinator_->scheduler().leases();
  std::size_t leased = 0;
  std::size_t wanted = 0;
  for (const auto& [number, entry] : coordinator_->scheduler().workers().all()) {
    const WorkerLoad& load = leases.loads().of(number);
    if (load.held() > 0 && !entry.connected) fail("a lease of a worker that is not there");
    leased += load.leases.size();
    std::size_t ahead = 0;
    for (const PackedKey key : load.leases) {
      const TaskRecord& record = *leases.find(key);
      const bool is_second = record.second && record.second->worker == number;
      if (is_second == (record.lease->worker == number)) fail("a lease of another worker");
      if (is_second && (record.task.ahead || record.alone)) fail("a copy that is not needed");
      if (record.task.ahead) ++ahead;
      if (!record.task.ahead && !is_second) ++wanted;
    }
    if (ahead != load.ahead) fail("look-ahead of a worker is miscounted");
  }
  if (leased != leases.leased() + leases.copies()) fail("a lease that belongs to no worker");
  std::size_t of_designs = 0;
  for (const auto& [id, design] : leases.queues().all())
    of_designs += design.wanted_leased;
  if (wanted != leases.wanted_leased() || wanted != of_designs) fail("leases are miscounted");
  check_slot_times();
}

/// The slots' time, by cause, is all of it and never less than none.
void SimulatedCluster::check_slot_times() {
  const SlotTimes times = coordinator_->status().slot_times;
  const double rest = times.slots - times.busy - times.idle_total();
  if (std::abs(rest) > 1e-6 * (1 + times.slots)) fail("idle times do not add up");
  const bool negative = std::ranges::any_of(times.idle, [](double time) { return time < -1e-9; });
  if (times.busy < 0 || negative) fail("a slot idles for less than no time");
}

}  // namespace swarmsmith::cluster
