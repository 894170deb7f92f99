#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "base/hash.h"
#include "irace_core/configuration.h"
#include "irace_core/race_event.h"

namespace swarmsmith::search {

/// A configuration that is new in a round.
struct Newcomer {
  Configuration configuration;
  std::int64_t parent = 0;  ///< id of the configuration from which it was made; 0 for none
};

/// The next runs that a strategy wants.
struct Round {
  /// New configurations, which get the next ids in this order.
  std::vector<Newcomer> newcomers;
  /// (configuration, pair), in canonical order: pair, then configuration.
  std::vector<std::pair<std::int64_t, std::int64_t>> runs;
  /// Set in the first round of an iteration: the elites with which it starts, and its number of
  /// runs.
  struct Start {
    std::vector<std::int64_t> elites;
    std::int64_t budget = 0;
    bool is_final = false;  ///< the stage that decides which configuration wins
  };
  std::optional<Start> start;
  /// Whether all runs are one step in the events; otherwise each pair is a step.
  bool is_one_step = false;
};

/// The consequences of a round's costs.
struct Verdict {
  /// If the iteration is over: its elites, best first, and the reason.
  std::optional<IterationEnded> ended;
  /// Ids of the configurations whose results may still matter, ascending.
  std::vector<std::int64_t> alive;
};

/// The decisions of a search in rounds: SearchLoop asks for a round, has it run, and gives its
/// costs to the strategy. A pure function of the options, the seed and the costs.
class Strategy {
 public:
  virtual ~Strategy() = default;

  /// The next round, whose first newcomer gets the id `next_id`; nothing when the search is over.
  virtual Expected<std::optional<Round>> next(std::int64_t next_id) = 0;
  /// Takes the costs of the round's runs, in their order; infinite costs are rejections.
  virtual Verdict take(std::span<const double> costs) = 0;

  virtual std::int64_t planned_iterations() const = 0;
  /// Adds `experiments` to the budget, which changes the plan. Called only after the search is
  /// over.
  virtual Expected<void> extend(std::int64_t experiments) = 0;
  virtual Expected<std::int64_t> least_extension() const = 0;
  /// Adds to the digest all state that later rounds depend on, except for the costs.
  virtual void add_to(Digest& digest) const = 0;
};

/// A configuration with the mean of its costs in a round; infinite if one of them was.
struct Scored {
  std::int64_t id = 0;
  double mean = 0;
  std::int64_t runs = 0;
};

/// The configurations of a round, best first: by mean, or by id if the means are equal (mission
/// scores with few values are often equal).
std::vector<Scored> ranked(std::span<const std::pair<std::int64_t, std::int64_t>> runs,
                           std::span<const double> costs);

/// The configurations as elites, with ranks from 1.
std::vector<Elite> as_elites(std::span<const Scored> scored);

/// Each id on each of `pairs` pairs from `first_pair` on, pair by pair.
std::vector<std::pair<std::int64_t, std::int64_t>> all_on(std::span<const std::int64_t> ids,
                                                          std::int64_t first_pair,
                                                          std::int64_t pairs);

/// "a budget of 500 experiments is too small ...": the same form as in irace_core/iterated_race.h.
Error too_small(std::int64_t budget, std::int64_t least);

}  // namespace swarmsmith::search
