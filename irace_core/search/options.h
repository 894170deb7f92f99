#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// The searches that a method can use. Numbers of the options below are runs and configurations; 0
/// is "automatic", and follows from the budget as said.
enum class SearchKind {
  Irace,      ///< iterated F-race (irace_core/iterated_race.h)
  Random,     ///< uniform draws; the best are run again
  FRace,      ///< one race of uniform draws (Vanilla)
  Evolution,  ///< EvoStick's genetic algorithm
  CmaEs,      ///< covariance matrix adaptation
  Annealing,  ///< simulated annealing; with start_temperature = 0 iterative improvement
};

/// All of them, in the order in which they are listed.
std::span<const SearchKind> all_searches();

/// What people call a search and its parts.
struct SearchWords {
  SearchKind kind;
  std::string_view name;               ///< in campaign files
  std::string_view round;              ///< an iteration as its events count them: "generation"
  std::string_view at_work;            ///< "racing", "searching"
  std::string_view where;              ///< where the winner's mean is from: "race", "final stage"
  std::string_view candidate;          ///< "member", "configuration"
  bool has_tests = false;              ///< statistical ones, that drop candidates
  std::string_view no_extension = {};  ///< why a finished one cannot go on; empty if it can
};

const SearchWords& words_of(SearchKind kind);
/// `irace`, `random`, `f-race`, `evolution`, `cma-es` or `annealing`.
inline std::string_view name_of(SearchKind kind) {
  return words_of(kind).name;
}

/// Changes whenever the search answers the same costs otherwise: a store of another version can be
/// read, but not continued.
int version_of(SearchKind kind);

struct RandomOptions {
  std::int64_t runs = 10;         ///< of each configuration, all on the same pairs
  std::int64_t finalists = 0;     ///< the best, which are run again; automatic: budget / 1000
  std::int64_t final_runs = 100;  ///< of each finalist, on further pairs

  friend bool operator==(const RandomOptions&, const RandomOptions&) = default;
};

struct FRaceOptions {
  std::int64_t configurations = 0;  ///< in the race; automatic: budget / 20

  friend bool operator==(const FRaceOptions&, const FRaceOptions&) = default;
};

enum class Mutation {
  Neat,    ///< as NEAT 1.2.1 mutates weights
  Normal,  ///< normal noise on every weight
};

struct EvolutionOptions {
  std::int64_t population = 100;
  std::int64_t runs = 10;  ///< of each member of a generation, on pairs of its own
  double parents = 0.2;    ///< share of the population that has children
  double elites = 0.2;     ///< share that goes on unchanged; at most `parents`
  Mutation mutation = Mutation::Neat;
  double step = 1;  ///< largest (neat) or standard (normal) change, in tenths of a range
  std::int64_t final_runs = 0;  ///< of each member at the end; automatic: the published ones

  friend bool operator==(const EvolutionOptions&, const EvolutionOptions&) = default;
};

struct CmaEsOptions {
  std::int64_t population = 100;
  std::int64_t runs = 10;
  double step = 2;              ///< first standard deviation, in tenths of a range
  std::int64_t final_runs = 0;  ///< as those of evolution

  friend bool operator==(const CmaEsOptions&, const CmaEsOptions&) = default;
};

enum class Cooling {
  Geometric,  ///< from start to end temperature over the whole budget, in standard deviations
  Published,  ///< from 125 score units, halved every third iteration, again and again
};

struct AnnealingOptions {
  std::int64_t window = 10;  ///< pairs on which machines are compared
  std::int64_t moved = 1;    ///< pairs of the window that each iteration replaces
  Cooling cooling = Cooling::Geometric;
  double start_temperature = 1;   ///< in standard deviations of random configurations' costs
  double end_temperature = 1e-3;  ///< the same
  std::int64_t final_runs = 100;  ///< of the best and the last
  bool start_at_random = false;   ///< else at the smallest machine

  friend bool operator==(const AnnealingOptions&, const AnnealingOptions&) = default;
};

/// A search and what it goes by; only the options of its own kind count.
struct SearchOptions {
  SearchKind kind = SearchKind::Irace;
  RandomOptions random;
  FRaceOptions f_race;
  EvolutionOptions evolution;
  CmaEsOptions cma_es;
  AnnealingOptions annealing;

  friend bool operator==(const SearchOptions&, const SearchOptions&) = default;
};

}  // namespace swarmsmith
