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

/// What searches are made of. Each is a struct of its options, KIND.h in this folder; its line in
/// CMakeLists.txt makes it known. The program knows most searches by no name: campaign files, their
/// digests, events, budgets, stores and what is shown of a search follow from what the
/// struct has, and it does not compile without:
///
/// - `kWords`, what people call it and its parts;
/// - `fields(options, visitor)`, which calls `visitor(SearchField, member)` for each key of its
///   table in campaign files, in a fixed order; a member is an integer, a double, a bool or an
///   enumeration;
/// - `start(search::Start)`, which makes its strategy, or, for races, `start_race`;
/// - `operator==`.
///
/// It may have besides
///
/// - `faults()`, what is wrong with the options that the limits of single ones cannot say;
/// - `planned(point)`, what options and budget say of a point before an event has said it;
/// - `texts(point)`, where the usual words do not say where it is.
///
/// Numbers of options are runs and configurations; 0 is "automatic" where it says so, and follows
/// from the budget.

/// What people call a search and its parts.
struct SearchWords {
  std::string_view name;               ///< in campaign files
  std::string_view round;              ///< an iteration as its events count them: "generation"
  std::string_view at_work;            ///< "racing", "searching"
  std::string_view where;              ///< where the winner's mean is from: "race", "final stage"
  std::string_view candidate;          ///< "member", "configuration"
  bool has_tests = false;              ///< statistical ones, that drop candidates: it is a race
  std::string_view no_extension = {};  ///< why a finished one cannot go on; empty if it can
  bool takes_repairs = false;          ///< its own configurations may be repaired
  bool wants_reals = false;            ///< needs reals without conditions, such as weights
  /// Changes whenever the search answers the same costs otherwise: a store of another version can
  /// be read, but not continued.
  int version = 1;
};

/// A key of a search's table in campaign files.
struct SearchField {
  std::string_view key;
  /// Limits of numbers, both included.
  double least = 0;
  double most = 0;
  /// The values of an enumeration, in its order.
  std::span<const std::string_view> choices{};
};

inline constexpr double kMostRuns = 1'000'000;

/// What is wrong with a search's options: of the first of the keys that a file has.
struct SearchFault {
  std::vector<std::string_view> keys;
  std::string message;
};

/// How far a search is, as its events say it; 0 where it is unknown.
struct SearchPoint {
  std::int64_t iteration = 0;   ///< as IterationStarted numbers them; 0 before the first
  std::int64_t iterations = 0;  ///< planned when it began
  std::int64_t finals = 0;      ///< final stages before it: of a search that was extended
  bool is_final = false;
  std::int64_t configurations = 0;  ///< of the iteration
  std::int64_t alive = 0;
  std::int64_t runs_wanted = 0;  ///< by the iteration
  std::int64_t runs = 0;         ///< of them, those that are there
  std::int64_t step = 0;         ///< the last one, through all iterations
  std::int64_t used = 0;         ///< by the design
  std::int64_t budget = 0;       ///< of the design
};

/// Where a search is, in three lengths (stage.h).
struct StageTexts {
  std::string name;   ///< "generation 41"
  std::string line;   ///< "generation 41 of 90: 20 members, 5 runs each"
  std::string stage;  ///< "generation 41 of 90, 12 of 20 members"
};

/// In a search's usual words, with this name of the part that it is in.
StageTexts usual_texts(const SearchWords& words, const SearchPoint& point, std::string name);

/// Parts of these texts.
namespace stage {

/// " of 90"; empty for 0.
std::string of(std::int64_t whole);
/// "configurations 1 to 220"; without a last one "configurations from 1 on".
std::string range(std::string_view what, std::int64_t first, std::int64_t last);
/// Of the iteration's candidates, those that have been run: runs come pair by pair.
std::int64_t ready(const SearchPoint& point);
/// "12 of 20 members"; empty before there are some.
std::string members(const SearchWords& words, const SearchPoint& point);
/// "5 runs each".
std::string each(const SearchPoint& point);

}  // namespace stage

namespace search {

class Strategy;

/// What local search walks in.
struct Neighbourhood {
  /// Where it starts.
  Configuration start;
  /// A valid configuration beside the given one.
  std::function<Expected<Configuration>(const Configuration&, Rng&)> perturb;
};

/// What a strategy is made of.
struct Start {
  const ParameterSpace& space;  ///< outlives the strategy
  const Scenario& scenario;
  std::vector<Configuration> initial;  ///< of the space, and not forbidden
  Repair repair;                       ///< empty unless `takes_repairs`
  std::optional<Neighbourhood> neighbourhood;
};

}  // namespace search
}  // namespace swarmsmith
