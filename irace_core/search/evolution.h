#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/rng.h"
#include "irace_core/parameter_space.h"
#include "irace_core/scenario.h"
#include "irace_core/search/search_parts.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith {

enum class Mutation {
  Neat,    ///< as NEAT 1.2.1 mutates weights
  Normal,  ///< normal noise on every weight
};

inline constexpr std::array<std::string_view, 2> kMutationNames = {"neat", "normal"};

/// EvoStick's genetic algorithm: the best fifth of a generation goes on unchanged and is run again
/// on the next generation's pairs; the rest are mutated copies of these, each of a parent drawn
/// uniformly; no crossover. After the last generation the next one is made once more, and its best
/// mean on further pairs wins (ARGoS3-NEAT, params/evostick*.ne with NEAT 1.2.1; docs/methods.md).
/// Draws of generation g come from the stream "evolution" with index g.
struct EvolutionOptions {
  static constexpr SearchWords kWords{.name = "evolution",
                                      .round = "generation",
                                      .at_work = "searching",
                                      .where = "final stage",
                                      .candidate = "member",
                                      .wants_reals = true};

  std::int64_t population = 100;
  std::int64_t runs = 10;  ///< of each member of a generation, on pairs of its own
  double parents = 0.2;    ///< share of the population that has children
  double elites = 0.2;     ///< share that goes on unchanged; at most `parents`
  Mutation mutation = Mutation::Neat;
  double step = 1;  ///< largest (neat) or standard (normal) change, in tenths of a range
  std::int64_t final_runs = 0;  ///< of each member at the end; automatic: the published ones

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visitor) {
    visitor(SearchField{"population", 2, kMostRuns}, self.population);
    visitor(SearchField{"runs", 1, kMostRuns}, self.runs);
    visitor(SearchField{"parents", 0, 1}, self.parents);
    visitor(SearchField{"elites", 0, 1}, self.elites);
    visitor(SearchField{"step", 0, 10}, self.step);
    visitor(SearchField{"final_runs", 0, kMostRuns}, self.final_runs);
    visitor(SearchField{.key = "mutation", .choices = kMutationNames}, self.mutation);
  }
  std::vector<SearchFault> faults() const;
  /// Errors: a space that is not a RealBox, a budget that is too small.
  Expected<std::unique_ptr<search::Strategy>> start(search::Start from) const;
  SearchPoint planned(SearchPoint point) const;
  friend bool operator==(const EvolutionOptions&, const EvolutionOptions&) = default;
};

namespace search {

/// Changes weights, units as RealBox has them, each towards [-5, 5].
///
/// Neat: with probability 1/2 severely, each weight 70 % += U, 20 % = U, 10 % as it is; else each
/// weight += U, but those of the last fifth of ten weights or more 50 %, 20 % and 30 %. U is
/// uniform in (-step, step). Normal: each weight += a normal number of standard deviation `step`.
void mutate(std::vector<double>& weights, Mutation mutation, double step, Rng& rng);

}  // namespace search
}  // namespace swarmsmith
