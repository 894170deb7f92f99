#include "tests/cluster/simulated_cluster.h"

#include <initializer_list>

namespace swarmsmith::cluster {
namespace {

using std::chrono::milliseconds;

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
                     .early_drains = up_to(1),
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
  schedule.faults.visits = up_to(20);
  return schedule;
}

Schedule hostile_schedule_of(std::uint64_t seed) {
  Schedule schedule = schedule_of(seed);
  Rng rng = Rng(seed).split("hostile");
  if (rng.bernoulli(0.5)) {
    // Nothing but the strangers; sometimes the coordinator crashes among them.
    const int crashes = rng.bernoulli(0.5) ? static_cast<int>(rng.uniform_int(1, 3)) : 0;
    schedule.faults = {.coordinator_crashes = crashes, .until = schedule.faults.until};
  }
  // A client that pauses a campaign that stops would wait for it.
  schedule.faults.commands = 0;
  const std::int64_t count = rng.uniform_int(1, 4);
  for (std::int64_t i = 0; i < count; ++i)
    schedule.hostile.push_back(kMisdeeds[rng.below(kMisdeeds.size())]);
  // Several of one kind, as one person would start them.
  if (rng.bernoulli(0.3)) schedule.hostile.assign(schedule.hostile.size(), schedule.hostile[0]);
  schedule.keys = rng.bernoulli(0.7);
  schedule.audit_every = rng.bernoulli(0.7) ? 1 : 5;
  if (rng.bernoulli(0.5)) schedule.faults.forgivings = static_cast<int>(rng.uniform_int(1, 5));
  return schedule;
}

}  // namespace swarmsmith::cluster
