#include "cli/replay/machine_filer.h"

#include <tuple>
#include <utility>

#include "cli/output/query_output.h"
#include "sim/control/controller.h"

namespace swarmsmith::cli {
namespace {

/// The seeds on which the candidate was tested after its race, in the order of the tests.
Expected<std::string> test_seeds(StoreReader& store, CandidateId candidate) {
  const auto rows =
      select(store,
             "SELECT seed FROM v_evaluations WHERE candidate = " + std::to_string(candidate.value) +
                 " AND purpose = 'test' AND seed IS NOT NULL ORDER BY pair",
             {.rows = 1'000'000, .seconds = 60});
  if (!rows) return Unexpected(rows.error());
  std::string seeds;
  for (const auto& cells : rows->cells)
    seeds += (seeds.empty() ? "" : ",") + cells.front().text;
  return seeds;
}

}  // namespace

Expected<MachineFiler> MachineFiler::open(StoreReader& store) {
  auto worlds = DesignWorlds::read(store);
  if (!worlds) return Unexpected(worlds.error());
  return MachineFiler(store, std::move(*worlds));
}

Expected<MachineHead> MachineFiler::head_of(CandidateId candidate) {
  const DesignId design = design_of(candidate);
  if (!world_ || world_->design.id != design) {
    auto world = worlds_.of(design);
    if (!world) return Unexpected(world.error());
    world_ = std::move(*world);
    const auto campaign = store_->campaign_of(design);
    if (!campaign) return Unexpected(campaign.error());
    campaign_ = campaign->row.digest;
  }
  if (!world_ || world_->has_parameters || world_->flavour.empty()) return MachineHead();
  auto seeds = test_seeds(*store_, candidate);
  if (!seeds) return Unexpected(seeds.error());
  return MachineHead{.flavour = world_->flavour,
                     .own_flavour = world_->own_flavour,
                     .turn_clock = world_->turn_clock,
                     .profile = world_->profile,
                     .mission = world_->mission,
                     .seeds = std::move(*seeds),
                     .method = world_->design.method,
                     .design = to_string(design),
                     .candidate = to_string(candidate),
                     .campaign = campaign_};
}

Expected<std::string> MachineFiler::text_of(CandidateId candidate) {
  const auto rows = select(*store_,
                           "SELECT d.mission, d.method, d.repetition, c.mean, c.runs, c.fsm_config "
                           "FROM v_candidates AS c "
                           "JOIN v_designs AS d ON d.design = c.design WHERE c.candidate = " +
                               std::to_string(candidate.value));
  if (!rows) return Unexpected(rows.error());
  if (rows->cells.empty()) {
    return unexpected(ErrorKind::NotFound, "the store has no candidate " + to_string(candidate));
  }
  const auto head = head_of(candidate);
  if (!head) return Unexpected(head.error());
  // In the order of the columns in the statement.
  const auto& cells = rows->cells.front();
  const auto& [mission, method, repetition, mean, runs, machine] = std::tie(
      cells[0].text, cells[1].text, cells[2].text, cells[3].text, cells[4].text, cells[5].text);
  std::string text = "# " + to_string(design_of(candidate)) + " " + mission + " " + method +
                     " repetition " + repetition + ": " + to_string(candidate);
  if (!mean.empty()) text += ", mean " + mean + " over " + runs + (runs == "1" ? " run" : " runs");
  const bool is_machine = architecture_of_text(machine) == Architecture::Machine;
  return text + "\n" + (head->flavour.empty() ? "" : head_text(*head)) +
         (is_machine ? "--fsm-config " : "") + machine + "\n";
}

}  // namespace swarmsmith::cli
