#include "tests/cluster/simulated_cluster.h"

#include <algorithm>
#include <cmath>

#include "base/overloaded.h"
#include "coordinator/paused_designs.h"
#include "proto/wire.h"

namespace swarmsmith::cluster {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// How long a campaign may take after the last fault: several rounds of the longest time-outs.
constexpr Duration kPatience = seconds(240);

/// Ten times what the busiest schedule needs.
constexpr std::uint64_t kMaxEvents = 300'000;

const char* const kScenario = "scenario";

CoordinatorOptions coordinator_options(std::int64_t first_worker, std::size_t campaigns) {
  CoordinatorOptions options;
  options.scheduler.campaigns.resize(campaigns);
  options.scheduler.first_worker = first_worker;
  for (CampaignPolicy& policy : options.scheduler.campaigns)
    policy.audit_every = 10;
  options.scenario = kScenario;
  return options;
}

/// 1 to 30 ms, a few of 400 ms; by the key alone. A slow worker stays below the time-out.
Duration time_of(PackedKey key, int slowness) {
  const std::uint64_t bits = mix64(key * 7919U);
  const Duration quick =
      bits % 40 == 0 ? Duration(milliseconds(400)) : Duration(microseconds(1000 + bits % 29'000));
  return std::min<Duration>(quick * slowness, std::max<Duration>(quick, seconds(20)));
}

}  // namespace

Schedule schedule_of(std::uint64_t seed) {
  Rng rng = Rng(seed).split("schedule");
  const auto one_of = [&](std::initializer_list<double> values) {
    return values.begin()[rng.below(values.size())];
  };
  const auto up_to = [&](std::int64_t n) { return static_cast<int>(rng.uniform_int(0, n)); };
  Schedule schedule;
  schedule.seed = seed;
  schedule.faults = {.loss = one_of({0, 0, 0.01, 0.1, 0.3}),
                     .doubled = one_of({0, 0, 0.05, 0.3}),
                     .late = one_of({0, 0, 0.01, 0.1}),
                     .cuts = up_to(4),
                     .worker_crashes = up_to(3),
                     .worker_drains = up_to(1),
                     .coordinator_crashes = up_to(3),
                     .pauses = up_to(3),
                     .slow_commit = one_of({0, 0.05, 0.5}),
                     .clock_steps = rng.bernoulli(0.3) ? up_to(3) : 0,
                     .total_crashes = rng.bernoulli(0.2) ? up_to(2) : 0,
                     .full_disks = rng.bernoulli(0.2) ? up_to(2) : 0,
                     .flaps = rng.bernoulli(0.2) ? up_to(2) : 0,
                     .until = milliseconds(rng.uniform_int(100, rng.bernoulli(0.8) ? 800 : 8000))};
  CampaignShape& campaign = schedule.campaign;
  campaign.seed = seed;
  // Mostly all designs at once; sometimes more than are open at a time.
  campaign.designs = rng.bernoulli(0.05) ? 6 : 1 + up_to(1);
  campaign.budget = 54 + up_to(20);
  campaign.tests = up_to(4);
  campaign.failing = rng.bernoulli(0.4);
  campaign.killing = rng.bernoulli(0.2);
  campaign.hopeless = rng.bernoulli(0.1);
  // Not beside clocks that jump: together they would make time-outs of evaluations that take 20 s.
  schedule.slow_worker = rng.bernoulli(0.1) && schedule.faults.clock_steps == 0;
  if (rng.bernoulli(0.15)) {
    schedule.other = campaign;
    schedule.other->seed = seed + 1;
    schedule.other->designs = 1;
    campaign.designs = 1;
  }
  schedule.faults.commands = up_to(4);
  return schedule;
}

SimulatedCluster::SimulatedCluster(const Schedule& schedule)
    : schedule_(schedule), rng_(Rng(schedule.seed).split("cluster")), workers_(kWorkers) {
  faults_end_ = now_ + schedule_.faults.until;
  campaigns_.push_back({.shape = schedule_.campaign});
  if (schedule_.other) campaigns_.push_back({.shape = *schedule_.other});
  for (Worker& worker : workers_)
    worker.slots = static_cast<int>(rng_.uniform_int(1, 3));
  if (schedule_.slow_worker) workers_.front().slowness = 100;
  start_coordinator();
  for (int i = 0; i < kWorkers; ++i)
    start_worker(i);
  plan_faults();
  plan_commands();
}

std::string SimulatedCluster::run() {
  const TimePoint limit = faults_end_ + kPatience;
  bool over = false;
  while (failure_.empty() && !queue_.empty()) {
    Event event = queue_.top();
    queue_.pop();
    now_ = event.at;
    event.what();
    if (order_ > kMaxEvents) fail("a storm of messages");
    if (now_ < faults_end_ || coordinator_ == nullptr || !coordinator_->finished()) {
      if (now_ > limit) fail("the campaign does not end");
      continue;
    }
    if (!std::exchange(over, true)) {
      over_ = now_;
      count();
      for (Running& running : campaigns_)
        check_answer(running);
    }
    if (workers_are_quiet()) break;
    if (now_ > limit) fail("a worker keeps results that are on disk");
  }
  return failure_;
}

/// As it was stored, and when it is derived again from nothing but the stored scores.
void SimulatedCluster::check_answer(Running& running) {
  const SimulatedDisk& disk = running.disk;
  const std::vector<std::string> wanted = undisturbed(running.shape).answer();
  const std::vector<std::string> stored = disk.answer();
  const auto [one, other] = std::ranges::mismatch(wanted, stored);
  if (one != wanted.end() || other != stored.end()) {
    fail("another answer than without faults: " + (other != stored.end() ? *other : "nothing") +
         ", and not " + (one != wanted.end() ? *one : "nothing"));
  }
  if (!disk.finished()) fail("the end of the campaign is not on disk");
  for (const DesignStateRow& design : disk.design_states()) {
    const bool over = design.state == DesignState::Finished || design.state == DesignState::Stopped;
    if (!over) fail("a design is not finished");
    if (design.used > running.shape.budget) fail("a design used more than its budget");
  }
  RacedCampaign again(running.shape, by_design(disk.scores(), {}, {}), {});
  if (!again.finished() || !again.take_tasks().empty()) fail("scores are missing on disk");
  write(running, again.take_rows());
  if (disk.answer() != stored) fail("another answer when it is derived again");
}

void SimulatedCluster::fail(const std::string& what) {
  if (failure_.empty()) failure_ = what;
}

void SimulatedCluster::at(TimePoint when, std::function<void()> what) {
  queue_.push({when, ++order_, std::move(what)});
}

SimulatedCluster::Process& SimulatedCluster::process(int index) {
  return index == kCoordinator ? coordinator_process_
                               : workers_[static_cast<std::size_t>(index)].process;
}

/// Happens only if the process still lives then, and waits while it is paused.
void SimulatedCluster::on_process(int index, Duration delay, std::function<void()> what) {
  const int life = process(index).life;
  at(now_ + delay, [this, index, life, what = std::move(what)]() mutable {
    const Process& it = process(index);
    if (!it.alive || it.life != life) return;
    if (now_ < it.paused_until) {
      on_process(index, it.paused_until - now_, std::move(what));
      return;
    }
    what();
  });
}

Duration SimulatedCluster::between(Duration low, Duration high) {
  return Duration(rng_.uniform_int(low.count(), high.count()));
}

void SimulatedCluster::plan_faults() {
  const Faults& faults = schedule_.faults;
  const auto sometimes = [&](int times, const std::function<void(int)>& what) {
    for (int i = 0; i < times; ++i) {
      const int worker = static_cast<int>(rng_.below(kWorkers));
      at(now_ + between(Duration{0}, faults.until), [what, worker] { what(worker); });
    }
  };
  sometimes(faults.worker_crashes, [this](int worker) { crash_worker(worker); });
  sometimes(faults.coordinator_crashes, [this](int) { crash_coordinator(); });
  sometimes(faults.worker_drains, [this](int worker) {
    on_process(worker, Duration{0}, [this, worker] {
      workers_[static_cast<std::size_t>(worker)].protocol->on_drain(clock(worker));
      settle_worker(worker);
    });
  });
  sometimes(faults.pauses, [this](int worker) {
    const int index = rng_.bernoulli(0.3) ? kCoordinator : worker;
    process(index).paused_until = now_ + between(milliseconds(10), seconds(12));
  });
  sometimes(faults.clock_steps, [this](int worker) {
    const int index = rng_.bernoulli(0.3) ? kCoordinator : worker;
    process(index).skew += between(-seconds(20), seconds(60));
    // Timers of the system fire by the new time.
    if (index != kCoordinator && process(index).alive) {
      on_process(index, Duration{0}, [this, index] { settle_worker(index); });
    }
  });
  sometimes(faults.total_crashes, [this](int) {
    for (int i = 0; i < kWorkers; ++i)
      crash_worker(i);
    crash_coordinator();
  });
  sometimes(faults.full_disks,
            [this](int) { disk_full_until_ = now_ + between(milliseconds(10), seconds(20)); });
  sometimes(faults.flaps, [this](int worker) { flap(worker, 10); });
  sometimes(faults.cuts, [this](int worker) {
    const TimePoint until = now_ + between(milliseconds(10), seconds(8));
    const std::uint64_t ways = rng_.below(3);
    if (ways != 0) process(worker).cut_in_until = until;
    if (ways != 1) process(worker).cut_out_until = until;
  });
}

/// A cable that is out and in again, a few times.
void SimulatedCluster::flap(int worker, int times) {
  if (times == 0) return;
  const TimePoint until = now_ + between(milliseconds(5), seconds(2));
  process(worker).cut_in_until = until;
  process(worker).cut_out_until = until;
  at(until + between(milliseconds(1), milliseconds(200)),
     [this, worker, times] { flap(worker, times - 1); });
}

// --- a person ---

/// Pauses and resumes while things go wrong; at the end everything is resumed.
void SimulatedCluster::plan_commands() {
  for (int i = 0; i < schedule_.faults.commands; ++i) {
    const auto kind = rng_.bernoulli(0.6) ? pb::Command::KIND_PAUSE : pb::Command::KIND_RESUME;
    const std::int64_t design = rng_.uniform_int(0, schedule_.campaign.designs);
    at(now_ + between(Duration{0}, schedule_.faults.until), [this, kind, design] {
      on_process(kCoordinator, Duration{0}, [this, kind, design] {
        // What a stopped process hears only now would come after the last word.
        if (now_ < faults_end_) command(kind, design);
      });
    });
  }
  if (schedule_.faults.commands > 0) at(faults_end_, [this] { resume_all(); });
}

void SimulatedCluster::command(pb::Command::Kind kind, std::int64_t design) {
  pb::ToCoordinator message;
  message.mutable_command()->set_campaign("cluster0");
  message.mutable_command()->set_kind(kind);
  message.mutable_command()->set_design(design);
  coordinator_->on_frame({kPerson, Role::Operator}, encode(message), clock(kCoordinator));
  settle_coordinator();
}

void SimulatedCluster::resume_all() {
  if (!coordinator_process_.alive || now_ < coordinator_process_.paused_until) {
    at(now_ + milliseconds(100), [this] { resume_all(); });
    return;
  }
  command(pb::Command::KIND_RESUME, 0);
  if (!coordinator_->paused().empty() && !coordinator_->finished()) {
    // Of a design that is over nobody cares.
    for (const DesignId design : campaigns_.front().source->unfinished()) {
      if (coordinator_->paused().contains(design)) fail("a design stays paused");
    }
  }
}

// --- network ---

void SimulatedCluster::transmit(int from, int to, PeerId connection, std::string frame) {
  const bool faulty = now_ < faults_end_;
  const bool cut = now_ < process(from).cut_out_until || now_ < process(to).cut_in_until;
  if (cut || (faulty && rng_.bernoulli(schedule_.faults.loss))) return;
  const int copies = faulty && rng_.bernoulli(schedule_.faults.doubled) ? 2 : 1;
  for (int i = 0; i < copies; ++i) {
    const bool late = faulty && rng_.bernoulli(schedule_.faults.late);
    const Duration delay =
        late ? between(milliseconds(1), seconds(4)) : between(microseconds(30), microseconds(300));
    on_process(to, delay, [this, from, to, connection, frame] {
      const Connection& over = connections_.at(connection);
      if (to == kCoordinator) {
        if (over.coordinator_life != coordinator_process_.life) return;
        coordinator_->on_frame({connection}, frame, clock(kCoordinator));
        settle_coordinator();
      } else {
        Worker& worker = workers_[static_cast<std::size_t>(to)];
        if (worker.connection != connection) return;
        worker.protocol->on_frame(frame, clock(to));
        settle_worker(to);
      }
      (void)from;
    });
  }
}

void SimulatedCluster::connect(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  if (worker.connection != 0) connections_[worker.connection].open = false;
  worker.connection = ++peers_;
  connections_[worker.connection] = {.worker = index,
                                     .worker_life = worker.process.life,
                                     .coordinator_life = coordinator_process_.life,
                                     .open = coordinator_process_.alive};
  if (coordinator_process_.alive) return;
  on_process(index, milliseconds(1), [this, index, connection = worker.connection] {
    Worker& it = workers_[static_cast<std::size_t>(index)];
    if (it.connection != connection) return;
    it.protocol->on_connection_lost(clock(index));
    settle_worker(index);
  });
}

void SimulatedCluster::to_coordinator(int index, std::string frame) {
  const PeerId connection = workers_[static_cast<std::size_t>(index)].connection;
  if (connections_.at(connection).open) transmit(index, kCoordinator, connection, std::move(frame));
}

SendStatus SimulatedCluster::to_worker(PeerId peer, const std::string& frame) {
  const Connection& connection = connections_.at(peer);
  if (!connection.open) return SendStatus::Gone;
  const Process& worker = process(connection.worker);
  if (!worker.alive || worker.life != connection.worker_life) return SendStatus::Sent;  // silence
  transmit(kCoordinator, connection.worker, peer, frame);
  return SendStatus::Sent;
}

/// Acknowledged means durable; failures are told without a row.
void SimulatedCluster::check_acknowledged(const std::string& frame) {
  google::protobuf::Arena arena;
  const Expected<const pb::ToWorker*> message = decode_to_worker(frame, arena);
  if (!message) return fail("the coordinator sent a frame that is malformed");
  for (const pb::Key& key : (*message)->acknowledged().keys()) {
    const PackedKey packed = *pack(key);
    const Running& running = campaigns_.at(campaign_of(packed));
    const SimulatedDisk& disk = running.disk;
    // What nobody wants any more need not be kept.
    if (disk.finished() || running.source->is_void(packed)) continue;
    if (!disk.holds(packed) && !failed_.contains(packed)) fail("acknowledged what is not on disk");
  }
}

/// Whoever asked is told when it is on disk: what the disk has is what will be after a crash.
void SimulatedCluster::check_confirmed(const std::string& frame) {
  google::protobuf::Arena arena;
  const Expected<const pb::ToWorker*> message = decode_to_worker(frame, arena);
  if (!message || !(*message)->has_command_reply()) return fail("no reply to a command");
  const auto is_command = [](const Row& row) { return std::holds_alternative<CommandRow>(row); };
  const Running& running = campaigns_.front();
  const bool more = std::ranges::any_of(running.uncommitted, [&](const Batch& batch) {
    return std::ranges::any_of(batch.rows, is_command);
  });
  if (!more && paused_designs(running.disk.commands()) != coordinator_->paused())
    fail("what a person was told of is not on disk");
}

// --- coordinator ---

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
  for (Running& running : campaigns_) {
    running.source = std::make_unique<RacedCampaign>(running.shape, running.disk);
    running.tickets = 0;
    running.uncommitted.clear();
    first_worker = std::max(first_worker, running.disk.next_worker());
    known.push_back(running.disk.scores());
    commands.push_back(running.disk.commands());
    works.push_back({.digest = "cluster" + std::to_string(works.size()),
                     .source = running.source.get(),
                     .known = known.back(),
                     .commands = commands.back()});
  }
  coordinator_ =
      std::make_unique<Coordinator>(coordinator_options(first_worker, campaigns_.size()), works);
  on_process(kCoordinator, Duration{0}, [this] { tick_coordinator(); });
}

void SimulatedCluster::crash_coordinator() {
  if (!coordinator_process_.alive) return;
  ++crashes_;
  coordinator_process_.alive = false;
  count();
  coordinator_.reset();
  for (Running& running : campaigns_) {
    running.source.reset();
    // Some of what waited for the disk may have come there all the same.
    const bool full = now_ < disk_full_until_;
    const std::uint64_t written = full ? 0 : rng_.below(running.uncommitted.size() + 1);
    for (std::uint64_t i = 0; i < written; ++i)
      write(running, running.uncommitted[i].rows);
    running.uncommitted.clear();
  }
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
  for (auto actions = coordinator_->take_actions(clock(kCoordinator)); !actions.empty();
       actions = coordinator_->take_actions(clock(kCoordinator))) {
    for (CoordinatorAction& action : actions) {
      std::visit(Overloaded{[&](const SendFrame& send) {
                              if (send.peer == kPerson) return check_confirmed(send.frame);
                              check_acknowledged(send.frame);
                              if (to_worker(send.peer, send.frame) == SendStatus::Gone) {
                                coordinator_->on_unreachable(send, clock(kCoordinator));
                              }
                            },
                            [&](AppendRows& rows) { append(rows.campaign, std::move(rows.rows)); },
                            [](const AnswerStatus&) {}},
                 action);
    }
  }
  check_leases();
  for (std::uint32_t index = 0; index < campaigns_.size(); ++index) {
    const std::string complaint = campaigns_[index].source->complaint();
    if (!complaint.empty()) fail(complaint);
    if (coordinator_->stopped(index)) fail("stopped: " + *coordinator_->stopped(index));
  }
}

void SimulatedCluster::append(std::uint32_t campaign, std::vector<Row> rows) {
  Running& running = campaigns_[campaign];
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
  if (const std::string complaint = running.disk.commit(rows); !complaint.empty()) fail(complaint);
}

/// Of a coordinator that ends.
void SimulatedCluster::count() {
  const SchedulerCounters& last = coordinator_->scheduler().counters();
  counters_.copies += last.copies;
  counters_.ahead += last.ahead;
  counters_.duplicates += last.duplicates;
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
      if (is_second == (record.lease->worker == number)) fail("a lease of somebody else");
      if (is_second && (record.task.ahead || record.alone)) fail("a copy that nobody needs");
      if (record.task.ahead) ++ahead;
      if (!record.task.ahead && !is_second) ++wanted;
    }
    if (ahead != load.ahead) fail("look-ahead of a worker is miscounted");
  }
  if (leased != leases.leased() + leases.copies()) fail("a lease that belongs to nobody");
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

// --- workers ---

void SimulatedCluster::start_worker(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  ++worker.process.life;
  worker.process.alive = true;
  worker.process.paused_until = {};
  worker.waiting.clear();
  worker.running = 0;
  worker.connection = 0;
  worker.tick_at = {};
  std::string id(kWorkerIdBytes, static_cast<char>(index + 1));
  id.back() = static_cast<char>(worker.process.life);
  worker.protocol = std::make_unique<WorkerProtocol>(
      WorkerIdentity{.id = id, .slots = worker.slots, .host = "here"}, WorkerOptions{},
      rng_.split("jitter", order_));
  worker.protocol->start(clock(index));
  settle_worker(index);
}

void SimulatedCluster::crash_worker(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  if (!worker.process.alive) return;
  ++crashes_;
  worker.process.alive = false;
  const bool cut = now_ < worker.process.cut_out_until;
  if (worker.connection != 0 && !cut) connections_[worker.connection].open = false;
  at(now_ + between(milliseconds(1), milliseconds(500)), [this, index] { start_worker(index); });
}

void SimulatedCluster::settle_worker(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  for (auto actions = worker.protocol->take_actions(); !actions.empty();
       actions = worker.protocol->take_actions()) {
    for (WorkerAction& action : actions) {
      if (worker.process.alive) carry_out(index, action);
    }
  }
  if (!worker.process.alive) return;
  start_items(index);
  schedule_tick(index);
}

void SimulatedCluster::carry_out(int index, WorkerAction& action) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  std::visit(
      Overloaded{[&](OpenConnection) { connect(index); },
                 [&](SendToCoordinator& send) { to_coordinator(index, std::move(send.frame)); },
                 [&](const UseScenario& use) {
                   if (use.scenario != kScenario) fail("another scenario");
                 },
                 [&](RunItems& run) {
                   for (WorkItem& item : run.items)
                     worker.waiting.push_back(std::move(item));
                 },
                 [&](TakeBack) {
                   std::vector<PackedKey> keys;
                   for (const WorkItem& item : worker.waiting)
                     keys.push_back(item.key);
                   worker.waiting.clear();
                   worker.protocol->on_taken_back(keys, clock(index));
                 },
                 [&](DropItems) { worker.waiting.clear(); },
                 [&](const Leave& leave) {
                   if (leave.code != ExitCode::Done) fail("a worker left: " + leave.reason);
                   worker.process.alive = false;
                   connections_[worker.connection].open = false;
                   at(now_ + milliseconds(200), [this, index] { start_worker(index); });
                 }},
      action);
}

void SimulatedCluster::start_items(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  while (worker.running < worker.slots && !worker.waiting.empty()) {
    const WorkItem item = std::move(worker.waiting.front());
    worker.waiting.pop_front();
    ++worker.running;
    worker.protocol->on_started(item.key, clock(index));
    on_process(index, time_of(item.key, worker.slowness),
               [this, index, item] { finish_item(index, item); });
  }
}

void SimulatedCluster::finish_item(int index, const WorkItem& item) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  const CampaignShape& shape = campaigns_.at(campaign_of(item.key)).shape;
  const Truth truth = truth_of(shape, {item.mission, item.machine, item.seed});
  if (truth.kind == Truth::Kind::Kills) {
    killers_.insert(item.key);
    return crash_worker(index);
  }
  --worker.running;
  const bool fails = truth.kind == Truth::Kind::Fails;
  if (fails) failed_.insert(item.key);
  worker.protocol->on_evaluated(
      {.key = item.key,
       .attempt = item.attempt,
       .score = truth.score,
       .state_digest = truth.state_digest,
       .wall_us =
           std::chrono::duration_cast<microseconds>(time_of(item.key, worker.slowness)).count(),
       .failure = fails ? "planted" : ""},
      clock(index));
  settle_worker(index);
}

void SimulatedCluster::schedule_tick(int index) {
  Worker& worker = workers_[static_cast<std::size_t>(index)];
  // The protocol thinks in its own host's time.
  const TimePoint due =
      std::max(worker.protocol->next_deadline() - worker.process.skew, now_ + microseconds(100));
  const bool pending = worker.tick_at > now_ && worker.tick_at <= due;
  if (pending) return;
  worker.tick_at = due;
  on_process(index, due - now_, [this, index, due] {
    Worker& it = workers_[static_cast<std::size_t>(index)];
    if (it.tick_at != due) return;
    it.tick_at = {};
    it.protocol->on_tick(clock(index));
    settle_worker(index);
  });
}

bool SimulatedCluster::workers_are_quiet() const {
  return std::ranges::all_of(workers_, [](const Worker& worker) {
    return worker.process.alive && worker.protocol->active() &&
           worker.protocol->unacknowledged() == 0;
  });
}

}  // namespace swarmsmith::cluster
