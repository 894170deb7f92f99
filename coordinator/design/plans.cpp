#include "coordinator/design/plans.h"

#include <memory>
#include <utility>

#include "base/assert.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/method_space.h"
#include "coordinator/design/repair.h"
#include "sim/control/controller.h"

namespace swarmsmith {
namespace {

/// Shared by all plans of a method, which may be destroyed at different times.
using SharedSpace = std::shared_ptr<const MethodSpace>;

/// Uses the given control software instead of a search.
Expected<void> put_baseline(DesignPlan& plan, const Method& method) {
  if (method.baseline.empty()) return {};
  // There is nothing to search for; the given control software is only tested.
  plan.only_test = true;
  if (method.baseline == kRandomMachine) {
    // A stream of its own: the same design draws the same machine, whatever else uses the seed.
    Rng rng = Rng(plan.scenario.seed).split("random machine");
    auto drawn = sample_uniform(plan.space, rng);
    if (!drawn) return Unexpected(drawn.error());
    plan.initial = {std::move(*drawn)};
    return {};
  }
  // It need not be in the method's space: a person may go beyond the space's ranges.
  const auto flavour = flavour_of(method);
  if (!flavour) return Unexpected(flavour.error());
  const auto given = parse_controller(method.baseline, **flavour);
  if (!given) return Unexpected(given.error());
  plan.initial = {Configuration(plan.space.size())};
  plan.describe = [text = text_of(*given, **flavour)](const Configuration&) { return text; };
  return {};
}

Expected<DesignPlan> plan_of(const Campaign& campaign, const DesignRow& row, std::size_t mission,
                             std::size_t method, const SharedSpace& space) {
  const CampaignMission& on = campaign.missions[mission];
  Scenario scenario = race_on(campaign, on);
  scenario.seed = static_cast<std::uint64_t>(row.seed);
  DesignPlan plan{.row = row,
                  .mission = static_cast<std::uint32_t>(mission),
                  .method = static_cast<std::uint32_t>(method),
                  .space = space->parameters(),
                  .scenario = scenario,
                  .search = campaign.methods[method].search,
                  .neighbourhood = space->neighbourhood(),
                  .describe = [space](const Configuration& c) { return space->text_of(c); },
                  .tests = {.count = on.test_count,
                            .on_test_instances = !on.instances.test.empty(),
                            .elites = campaign.test_nb_elites,
                            .every_iteration = campaign.test_iteration_elites},
                  .source = campaign.target ? "command" : campaign.profile.name,
                  .initial = space->initial(),
                  .only_test = campaign.only_test};
  for (const Profile& profile : campaign.test_profiles)
    plan.tests.profiles.push_back(profile.name);
  if (!campaign.repair.empty()) {
    const std::string folder = campaign.target ? campaign.target->folder : "";
    plan.repair = repair_by(campaign.repair, folder, space);
  }
  if (auto put = put_baseline(plan, campaign.methods[method]); !put) {
    return Unexpected(put.error());
  }
  return plan;
}

}  // namespace

Expected<std::vector<DesignPlan>> plans_of(const Campaign& campaign) {
  std::vector<SharedSpace> spaces;
  for (const Method& method : campaign.methods) {
    auto space = MethodSpace::make(method, static_cast<int>(campaign.digits),
                                   campaign.target && campaign.target->aclib);
    if (!space) return Unexpected(space.error());
    spaces.push_back(std::make_shared<const MethodSpace>(std::move(*space)));
  }
  std::vector<DesignPlan> plans;
  const std::vector<DesignRow> rows = design_rows(campaign);
  for (std::size_t mission = 0; mission < campaign.missions.size(); ++mission) {
    for (std::size_t method = 0; method < campaign.methods.size(); ++method) {
      const std::int64_t repetitions = repetitions_of(campaign, campaign.methods[method]);
      for (std::int64_t repetition = 1; repetition <= repetitions; ++repetition) {
        SWARMSMITH_ASSERT(plans.size() < rows.size(), "each plan has its row");
        const DesignRow& row = rows[plans.size()];
        SWARMSMITH_ASSERT(row.mission == campaign.missions[mission].mission.name &&
                              row.method == campaign.methods[method].name &&
                              row.repetition == repetition,
                          "designs are in the order of missions, methods, repetitions");
        auto plan = plan_of(campaign, row, mission, method, spaces[method]);
        if (!plan) return Unexpected(plan.error());
        plans.push_back(std::move(*plan));
      }
    }
  }
  return plans;
}

}  // namespace swarmsmith
