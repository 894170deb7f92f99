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

/// EvoStick's genetic algorithm: the best fifth of a generation stays unchanged and is run again on
/// the next generation's pairs; the other members are mutated copies of these, each of a parent
/// drawn uniformly, without crossover. After the last generation one more is bred; its members are
/// run on further pairs, and the best mean wins (ARGoS3-NEAT, params/evostick*.ne with NEAT 1.2.1;
/// docs/methods.md). Draws of generation g come from the stream "evolution" with index g.
struct EvolutionOptions {
  static constexpr SearchWords kWords{.name = "evolution",
                                      .round = "generation",
                                      .at_work = "searching",
                                      .where = "final stage",
                                      .candidate = "member",
                                      .wants_reals = true};

  std::int64_t population = 100;
  std::int64_t runs = 10;  ///< runs of each member of a generation, on pairs of that generation
  double parents = 0.2;    ///< share of the population that has children
  double elites = 0.2;     ///< share that stays unchanged; at most `parents`
  Mutation mutation = Mutation::Neat;
  /// Largest change (neat) or standard deviation of the change (normal), in tenths of a range.
  double step = 1;
  std::int64_t final_runs = 0;  ///< of each member at the end; automatic: the published numbers

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
  /// A space that is not a RealBox and a budget that is too small are errors.
  Expected<std::unique_ptr<search::Strategy>> start(search::Start from) const;
  SearchPoint planned(SearchPoint point) const;
  friend bool operator==(const EvolutionOptions&, const EvolutionOptions&) = default;
};

namespace search {

/// Changes weights that are in the units of RealBox, where the range is [-5, 5].
///
/// Neat: with probability 1/2 the mutation is severe: of the weights, 70 % += U, 20 % = U, and 10 %
/// stay unchanged. Otherwise every weight += U; if there are ten weights or more, the last fifth
/// has 50 %, 20 % and 30 % instead. U is uniform in (-step, step). Normal: each weight += a normal
/// number with standard deviation `step`.
void mutate(std::vector<double>& weights, Mutation mutation, double step, Rng& rng);

}  // namespace search
}  // namespace swarmsmith
