#include "tests/cluster/simulated_cluster.h"

#include "proto/wire.h"
#include "proto/wire.pb.h"

namespace swarmsmith::cluster {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

}  // namespace

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
  sometimes(faults.worker_drains, [this](int worker) { drain_worker(worker, Duration{0}); });
  sometimes(faults.early_drains,
            [this](int worker) { ++workers_[static_cast<std::size_t>(worker)].early_drains; });
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
  sometimes(faults.forgivings,
            [this](int) { on_process(kCoordinator, Duration{0}, [this] { forgive(); }); });
  sometimes(faults.flaps, [this](int worker) { flap(worker, 10); });
  sometimes(faults.visits, [this](int) {
    for (Running& running : campaigns_)
      running.disk.visit();
  });
  sometimes(faults.cuts, [this](int worker) {
    const TimePoint until = now_ + between(milliseconds(10), seconds(8));
    const std::uint64_t ways = rng_.below(3);
    if (ways != 0) process(worker).cut_in_until = until;
    if (ways != 1) process(worker).cut_out_until = until;
  });
}

/// SIGTERM.
void SimulatedCluster::drain_worker(int index, Duration after) {
  on_process(index, after, [this, index] {
    workers_[static_cast<std::size_t>(index)].protocol->on_drain(clock(index));
    settle_worker(index);
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
    // A design that is over does not matter.
    for (const DesignId design : campaigns_.front().source->unfinished()) {
      if (coordinator_->paused().contains(design)) fail("a design stays paused");
    }
  }
}

}  // namespace swarmsmith::cluster
