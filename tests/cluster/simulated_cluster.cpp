#include "tests/cluster/simulated_cluster.h"

#include <algorithm>

#include "base/overloaded.h"
#include "coordinator/service/paused_designs.h"
#include "proto/wire.h"

namespace swarmsmith::cluster {
namespace {

using std::chrono::seconds;

/// How long a campaign may take after the last fault: several rounds of the longest time-outs.
constexpr Duration kPatience = seconds(240);

/// Ten times what the busiest schedule needs, and what a hostile peer may say.
constexpr std::uint64_t kMaxEvents = 300'000;
constexpr std::uint64_t kMaxEventsOfStranger = 100'000;

}  // namespace

SimulatedCluster::SimulatedCluster(const Schedule& schedule)
    : schedule_(schedule), rng_(Rng(schedule.seed).split("cluster")), workers_(kWorkers) {
  faults_end_ = now_ + schedule_.faults.until;
  campaigns_.push_back({.shape = schedule_.campaign});
  if (schedule_.other) campaigns_.push_back({.shape = *schedule_.other});
  for (Worker& worker : workers_)
    worker.slots = static_cast<int>(rng_.uniform_int(1, 3));
  if (schedule_.slow_worker) workers_.front().slowness = 100;
  // They are there first, to hear how the workers introduce themselves.
  invite_strangers();
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
    if (order_ > kMaxEvents + strangers_.size() * kMaxEventsOfStranger) fail("a storm of messages");
    if (now_ < faults_end_ || coordinator_ == nullptr || !coordinator_->finished()) {
      if (now_ > limit) fail("the campaign does not end");
      continue;
    }
    if (!std::exchange(over, true)) {
      over_ = now_;
      count();
      for (Running& running : campaigns_) {
        if (stopped_.empty()) check_answer(running);
      }
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
    if (is_excused()) return;
    fail("another answer than without faults: " + (other != stored.end() ? *other : "nothing") +
         ", and not " + (one != wanted.end() ? *one : "nothing"));
  }
  if (!disk.finished()) fail("the end of the campaign is not on disk");
  for (const DesignStateRow& design : disk.design_states()) {
    const bool over = is_over(design.state);
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

}  // namespace swarmsmith::cluster
