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

/// A configuration that a round adds.
struct Newcomer {
  Configuration configuration;
  std::int64_t parent = 0;  ///< id of the configuration that it was made from; 0 for none
};

/// What a strategy wants to be run next.
struct Round {
  /// Get the next ids, in this order.
  std::vector<Newcomer> newcomers;
  /// (configuration, pair), in canonical order: pair, then configuration.
  std::vector<std::pair<std::int64_t, std::int64_t>> runs;
  /// The first round of an iteration: the elites that it starts with, and its number of runs.
  struct Start {
    std::vector<std::int64_t> elites;
    std::int64_t budget = 0;
    bool is_final = false;  ///< the stage that decides who wins
  };
  std::optional<Start> start;
  /// All runs are one step of the events; else each pair is.
  bool is_one_step = false;
};

/// What a round's costs led to.
struct Verdict {
  /// The iteration is over: its elites, best first, and why.
  std::optional<IterationEnded> ended;
  /// Ids whose results may still matter, ascending.
  std::vector<std::int64_t> alive;
};

/// What makes a search in rounds: SearchLoop asks for a round, has it run, and tells its
/// costs. A pure function of the options, the seed and the costs.
class Strategy {
 public:
  virtual ~Strategy() = default;

  /// The next round, whose first newcomer gets the id `next_id`; nothing when the search is over.
  virtual Expected<std::optional<Round>> next(std::int64_t next_id) = 0;
  /// Costs of the round's runs, in their order; infinite ones are rejections.
  virtual Verdict take(std::span<const double> costs) = 0;

  virtual std::int64_t planned_iterations() const = 0;
  /// Of `experiments` more: what is planned now changes. The search is over when it is called.
  virtual Expected<void> extend(std::int64_t experiments) = 0;
  virtual Expected<std::int64_t> least_extension() const = 0;
  /// Everything that later rounds depend on, but for the costs.
  virtual void add_to(Digest& digest) const = 0;
};

/// A configuration with the mean of its costs in a round; infinite when one of them was.
struct Scored {
  std::int64_t id = 0;
  double mean = 0;
  std::int64_t runs = 0;
};

/// Those of a round, best first: by mean, equal ones by id (mission scores of few values tie
/// often).
std::vector<Scored> ranked(std::span<const std::pair<std::int64_t, std::int64_t>> runs,
                           std::span<const double> costs);

/// As elites, ranks from 1.
std::vector<Elite> as_elites(std::span<const Scored> scored);

/// Every id on every pair from `first_pair` on, pair by pair.
std::vector<std::pair<std::int64_t, std::int64_t>> all_on(std::span<const std::int64_t> ids,
                                                          std::int64_t first_pair,
                                                          std::int64_t pairs);

/// "a budget of 500 experiments is too small ...": the form of irace_core/iterated_race.h.
Error too_small(std::int64_t budget, std::int64_t least);

}  // namespace swarmsmith::search
