#include "cli/irace/cost_events.h"

#include <variant>

#include "programs/cost.h"

namespace swarmsmith::cli {

void CostEvents::add(std::optional<std::size_t> campaign, const Row& row, TimePoint now) {
  Row told = row;
  if (auto* step = std::get_if<RaceStepRow>(&told)) {
    step->mean_best = to_cost(step->mean_best);
  } else if (auto* elite = std::get_if<EliteRow>(&told)) {
    elite->mean = to_cost(elite->mean);
  } else if (auto* state = std::get_if<DesignStateRow>(&told)) {
    state->best_mean = to_cost(state->best_mean);
  } else if (auto* conflict = std::get_if<ConflictRow>(&told)) {
    conflict->kept_score = to_cost(conflict->kept_score);
    conflict->other_score = to_cost(conflict->other_score);
  }
  progress_.add(campaign, told, now);
}

}  // namespace swarmsmith::cli
