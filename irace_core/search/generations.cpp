#include "irace_core/search/generations.h"

#include <algorithm>
#include <iterator>

#include "base/assert.h"

namespace swarmsmith::search {
namespace {

/// Runs of each member in the final stage. Between the published budgets the stage gets a fifth of
/// the budget.
std::int64_t published_final_runs(std::int64_t budget, std::int64_t population) {
  constexpr std::int64_t kLargeBudget = 200'000;
  // docs/methods.md, `evolution`: 20 runs for a budget of 10,000, 100 for 50,000 and 100,000, 500
  // for 200,000.
  if (budget >= kLargeBudget) return 500;
  return std::clamp<std::int64_t>(budget / (5 * population), 1, 100);
}

}  // namespace

Expected<GenerationPlan> plan_generations(std::int64_t budget, std::int64_t population,
                                          std::int64_t runs, std::int64_t final_runs) {
  const bool is_automatic = final_runs == 0;
  if (is_automatic) final_runs = published_final_runs(budget, population);
  const std::int64_t least = population * (runs + (is_automatic ? 1 : final_runs));
  if (budget < least) return Unexpected(too_small(budget, least));
  // With a small budget, runs for the first generation are reserved first; runs that are given fit.
  final_runs = std::min(final_runs, (budget - population * runs) / population);
  const std::int64_t generations = (budget - population * final_runs) / (population * runs);
  // Runs that are not enough for a generation go to the final stage, so that the budget is used up.
  const std::int64_t left = budget - generations * population * runs;
  SWARMSMITH_ASSERT(generations >= 1 && left >= population,
                    "the budget allows a generation and a final stage");
  return GenerationPlan{.generations = generations,
                        .population = population,
                        .configurations = generations * population,
                        .runs = runs,
                        .finalists = population,
                        .final_runs = left / population};
}

Expected<std::optional<Round>> Generations::next(std::int64_t next_id) {
  if (over_) return std::nullopt;
  ++generation_;
  const std::int64_t size =
      // The last part of a search whose generations share their pairs may be smaller.
      is_final() ? plan_.finalists : std::min(plan_.population, plan_.configurations - bred_);
  SWARMSMITH_ASSERT(size >= 1, "a generation has a member, and the final stage a finalist");
  auto brood = is_final() ? breeder_->finalists(size, next_id, last_)
                          : breeder_->breed(++generation_number_, size, next_id, last_);
  if (!brood) return Unexpected(brood.error());
  bred_ += size;
  Round round;
  std::vector<std::int64_t> ids = std::move(brood->known);
  for (std::size_t i = 0; i < brood->newcomers.size(); ++i)
    ids.push_back(next_id + static_cast<std::int64_t>(i));
  round.newcomers = std::move(brood->newcomers);
  SWARMSMITH_ASSERT(static_cast<std::int64_t>(ids.size()) == size,
                    "a generation has its full size");
  // The final stage uses pairs that no generation has used, so that the winner is not just the
  // member that was lucky on its own pairs.
  const std::int64_t pairs = is_final() ? plan_.final_runs : plan_.runs;
  const std::int64_t first_pair = plan_.fresh_pairs || is_final() ? next_pair_ : 1;
  next_pair_ = std::max(next_pair_, first_pair + pairs);
  // All members run on the same pairs, so differences of means are not due to the choice of pairs.
  round.runs = all_on(ids, first_pair, pairs);
  round.start = Round::Start{.elites = elites_,
                             .budget = static_cast<std::int64_t>(round.runs.size()),
                             .is_final = is_final()};
  runs_ = round.runs;
  return round;
}

Verdict Generations::take(std::span<const double> costs) {
  SWARMSMITH_ASSERT(costs.size() == runs_.size(), "there is a cost for each run");
  std::vector<Scored> order = ranked(runs_, costs);
  over_ = is_final();
  // The winner is decided by the final stage alone, not by the means of earlier generations.
  const std::vector<Scored> elites = is_final() ? order : breeder_->elites(order);
  elites_.clear();
  for (const Scored& elite : elites)
    elites_.push_back(elite.id);
  Verdict verdict;
  verdict.alive = elites_;
  std::ranges::sort(verdict.alive);
  verdict.ended = IterationEnded{
      .reason = over_ ? "the final stage is over" : "every member was run on every pair",
      .elites = as_elites(elites)};
  // An extension continues from the last generation, not from the final stage.
  if (!over_) last_ = std::move(order);
  return verdict;
}

Expected<void> Generations::extend(std::int64_t experiments) {
  const auto least = least_extension();
  if (!least) return Unexpected(least.error());
  if (experiments < *least) {
    return bad_input(
        "is too little for a further generation and a final stage: it must be at least " +
        std::to_string(*least));
  }
  // The finished plan had its generations and a final stage. The new one ends with a final stage
  // again (docs/methods.md).
  iterations_before_ += plan_.generations + 1;
  const std::int64_t finals = plan_.finalists * plan_.final_runs;
  const std::int64_t configurations = (experiments - finals) / plan_.runs;
  plan_.generations = configurations / plan_.population;
  plan_.configurations = plan_.generations * plan_.population;
  if (plan_.may_be_cut()) {
    plan_.configurations = configurations;
    plan_.generations = (configurations + plan_.population - 1) / plan_.population;
  }
  SWARMSMITH_ASSERT(plan_.generations >= 1, "the plan has at least one generation");
  generation_ = 0;
  bred_ = 0;
  over_ = false;
  return {};
}

Expected<std::int64_t> Generations::least_extension() const {
  // The smallest part is a single configuration if generations share their pairs, else a whole
  // generation.
  const std::int64_t least = plan_.may_be_cut() ? 1 : plan_.population;
  return least * plan_.runs + plan_.finalists * plan_.final_runs;
}

void Generations::add_to(Digest& digest) const {
  digest.add(generation_number_);
  digest.add(generation_);
  digest.add(next_pair_);
  for (const Scored& one : last_) {
    digest.add(one.id);
    digest.add(one.mean);
  }
  breeder_->add_to(digest);
}

SearchPoint planned_by(const Expected<GenerationPlan>& plan, SearchPoint point) {
  if (!plan) return point;
  point.iterations = plan->generations + 1;
  point.is_final = point.iteration > plan->generations;
  return point;
}

}  // namespace swarmsmith::search
