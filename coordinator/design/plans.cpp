#include "coordinator/design/plans.h"

#include <memory>
#include <utility>

#include "base/assert.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/machine_space.h"
#include "sim/control/machine_text.h"

namespace swarmsmith {
namespace {

/// Shared by the plans of one method, which may outlive each other.
struct MethodSpace {
  MachineSpace space;
  const Flavour* flavour = nullptr;
};

Expected<std::shared_ptr<const MethodSpace>> space_of(const Method& method, int digits) {
  auto flavour = find_flavour(method.flavour);
  if (!flavour) return Unexpected(flavour.error());
  auto space = MachineSpace::make(method, **flavour, digits);
  if (!space) return Unexpected(space.error());
  return std::make_shared<const MethodSpace>(MethodSpace{std::move(*space), *flavour});
}

CandidateText text_of(const MethodSpace& method, const Configuration& configuration) {
  const Machine machine = method.space.to_machine(configuration);
  return {.parameters = parameters_json(method.space.parameters(), configuration),
          .machine = print_machine(machine, *method.flavour),
          .modules = modules_json(machine),
          .states = static_cast<std::int64_t>(machine.states.size()),
          .transitions = transition_count(machine)};
}

}  // namespace

Expected<std::vector<DesignPlan>> plans_of(const Campaign& campaign) {
  std::vector<std::shared_ptr<const MethodSpace>> spaces;
  for (const Method& method : campaign.methods) {
    auto space = space_of(method, static_cast<int>(campaign.digits));
    if (!space) return Unexpected(space.error());
    spaces.push_back(std::move(*space));
  }
  std::vector<DesignPlan> plans;
  const std::vector<DesignRow> rows = design_rows(campaign);
  for (std::size_t mission = 0; mission < campaign.missions.size(); ++mission) {
    for (std::size_t method = 0; method < campaign.methods.size(); ++method) {
      for (std::int64_t repetition = 1; repetition <= campaign.repetitions; ++repetition) {
        const DesignRow& row = rows[plans.size()];
        SWARMSMITH_ASSERT(row.mission == campaign.missions[mission].mission.name &&
                              row.method == campaign.methods[method].name &&
                              row.repetition == repetition,
                          "designs are in the order of missions, methods, repetitions");
        Scenario scenario = campaign.race;
        scenario.seed = static_cast<std::uint64_t>(row.seed);
        plans.push_back({.row = row,
                         .mission = static_cast<std::uint32_t>(mission),
                         .method = static_cast<std::uint32_t>(method),
                         .space = spaces[method]->space.parameters(),
                         .scenario = scenario,
                         .describe =
                             [space = spaces[method]](const Configuration& configuration) {
                               return text_of(*space, configuration);
                             },
                         .test_count = campaign.missions[mission].test_count,
                         .source = campaign.profile.name});
      }
    }
  }
  return plans;
}

}  // namespace swarmsmith
