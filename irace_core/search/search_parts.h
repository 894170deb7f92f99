#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/rng.h"
#include "irace_core/iterated_race.h"
#include "irace_core/parameter_space.h"
#include "irace_core/scenario.h"

namespace swarmsmith {

/// The parts of a search. Each search is a struct of its options, in KIND.h in this folder; a line
/// in CMakeLists.txt adds it to the program. Most code does not name individual searches: campaign
/// files, their digests, events, budgets, stores and displayed texts are derived from the members
/// of the struct. It does not compile without:
///
/// - `kWords`, the names of the search and its parts;
/// - `fields(options, visitor)`, which calls `visitor(SearchField, member)` for each key of the
///   search's table in campaign files, in a fixed order; a member is an integer, a double, a bool
///   or an enumeration;
/// - `start(search::Start)`, which makes its strategy, or, for races, `start_race`;
/// - `operator==`.
///
/// It may also have
///
/// - `faults()`, the errors in the options that the limits of single options cannot express;
/// - `planned(point)`, which fills in a point from options and budget before an event has reported
///   it;
/// - `texts(point)`, if the usual texts do not describe where the search is.
///
/// Numbers in options are runs or configurations; 0 means "automatic" where the comment says so,
/// and the value is then computed from the budget.

/// The names of a search and its parts.
struct SearchWords {
  std::string_view name;     ///< in campaign files
  std::string_view round;    ///< the name of an iteration in events: "generation"
  std::string_view at_work;  ///< "racing", "searching"
  /// The stage that the winner's mean is from: "race", "final stage".
  std::string_view where;
  std::string_view candidate;  ///< "member", "configuration"
  bool has_tests = false;      ///< whether statistical tests drop candidates, as in a race
  /// Why a finished search cannot be extended; empty if it can.
  std::string_view no_extension = {};
  bool takes_repairs = false;  ///< whether its sampled configurations may be repaired
  /// Whether it needs reals without conditions, such as weights.
  bool wants_reals = false;
  /// Changes whenever the search gives different results for the same costs: a store with another
  /// version can be read, but not continued.
  int version = 1;
};

/// A key of a search's table in campaign files.
struct SearchField {
  std::string_view key;
  /// Limits of numbers, both included.
  double least = 0;
  double most = 0;
  /// The values of an enumeration, in the order of its definition.
  std::span<const std::string_view> choices{};
};

inline constexpr double kMostRuns = 1'000'000;

/// An error in a search's options; it is reported for the first of these keys that the file has.
struct SearchFault {
  std::vector<std::string_view> keys;
  std::string message;
};

/// The progress of a search according to its events; 0 where it is unknown.
struct SearchPoint {
  std::int64_t iteration = 0;   ///< as IterationStarted numbers them; 0 before the first
  std::int64_t iterations = 0;  ///< as planned when this iteration began
  std::int64_t finals = 0;      ///< number of final stages before it, if the search was extended
  bool is_final = false;
  std::int64_t configurations = 0;  ///< of the iteration
  std::int64_t alive = 0;
  std::int64_t runs_wanted = 0;  ///< by the whole iteration
  std::int64_t runs = 0;         ///< runs of the iteration that are finished
  std::int64_t step = 0;         ///< the last one, counted over all iterations
  std::int64_t used = 0;         ///< by the design
  std::int64_t budget = 0;       ///< of the design
};

/// Descriptions of where a search is, in three lengths (stage.h).
struct StageTexts {
  std::string name;   ///< "generation 41"
  std::string line;   ///< "generation 41 of 90: 20 members, 5 runs each"
  std::string stage;  ///< "generation 41 of 90, 12 of 20 members"
};

/// The usual texts of a search; `name` is the part of the search that it is in.
StageTexts usual_texts(const SearchWords& words, const SearchPoint& point, std::string name);

/// Parts of these texts.
namespace stage {

/// " of 90"; empty for 0.
std::string of(std::int64_t whole);
/// "configurations 1 to 220"; without a last one "configurations from 1 on".
std::string range(std::string_view what, std::int64_t first, std::int64_t last);
/// The number of the iteration's candidates that have been run: runs arrive pair by pair.
std::int64_t ready(const SearchPoint& point);
/// "12 of 20 members"; empty as long as the iteration has no members.
std::string members(const SearchWords& words, const SearchPoint& point);
/// "5 runs each".
std::string each(const SearchPoint& point);

}  // namespace stage

namespace search {

class Strategy;

/// The neighbourhood in which a local search moves.
struct Neighbourhood {
  /// The configuration at which the search starts.
  Configuration start;
  /// Returns a valid neighbour of the given configuration.
  std::function<Expected<Configuration>(const Configuration&, Rng&)> perturb;
};

/// The arguments for making a strategy.
struct Start {
  const ParameterSpace& space;  ///< outlives the strategy
  const Scenario& scenario;
  std::vector<Configuration> initial;  ///< configurations of the space that are not forbidden
  Repair repair;                       ///< empty unless `takes_repairs`
  std::optional<Neighbourhood> neighbourhood;
};

}  // namespace search
}  // namespace swarmsmith
