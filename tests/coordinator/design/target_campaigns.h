#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/rng.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/design/campaign_runner.h"
#include "tests/coordinator/design/memory.h"

namespace swarmsmith {

/// A campaign of one design that a program evaluates on three instances; the texts are further
/// lines of [race], [simulator] and [mission.instances].
Campaign campaign_with(const std::string& race, const std::string& simulator = "",
                       const std::string& test = "");

std::vector<DesignPlan> plans(const Campaign& campaign);

using Answer = std::function<Outcome(const Task&)>;

/// A cost and a time that depend on nothing but what a program would be told.
Outcome honest(const Task& task);
/// As with a targetEvaluator: a run says its time alone, a call the cost.
Outcome judged(const Task& task);

/// Lines of [race] and [simulator] that can be mixed freely.
struct TargetChoices {
  std::string race;
  std::string simulator;
  std::string test;
  bool evaluates = false;
};

TargetChoices random_options(Rng& rng);

/// A target that stops at its bound, and rejects some of what it is given.
Outcome random_target(const Task& task, bool evaluates, double rejects);

/// Runs until finished, or so many outcomes, in an order of its own; gives all tasks that were
/// taken.
std::vector<Task> run(CampaignRunner& runner, Memory& memory, Rng order,
                      const Answer& answer = honest, std::size_t limit = ~std::size_t{0});

struct Ran {
  Memory memory;
  std::vector<Task> tasks;
};

Ran undisturbed(std::vector<DesignPlan> plans, const Answer& answer = honest);
Ran undisturbed(const Campaign& campaign, const Answer& answer = honest);

/// The designs, left and taken up again five times at places that `rng` draws, must come to the
/// same answer.
void expect_resumable(const std::vector<DesignPlan>& plans, const Answer& answer, Rng rng);
void expect_resumable(const Campaign& campaign, const Answer& answer = honest);

}  // namespace swarmsmith
