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

enum class Cooling {
  Geometric,  ///< from start to end temperature over the whole budget, in standard deviations
  /// Starts at 125 score units, is halved after every third iteration, and restarts at its end.
  Published,
};

inline constexpr std::array<std::string_view, 2> kCoolingNames = {"geometric", "published"};

/// Simulated annealing in the manner of IcePop (docs/methods.md). Configurations are compared on a
/// window of pairs that moves on with each iteration: the incumbent and the best configuration so
/// far are run on the new pairs, the perturbed configuration on all pairs of the window. The
/// perturbed configuration is accepted if its mean on the window is not worse than the incumbent's,
/// otherwise with probability exp(-loss / T); with T = 0 throughout, the search is iterative
/// improvement. All runs count in the budget. At the end, the best configuration and the last
/// incumbent are run on further pairs, and the one with the better mean wins.
///
/// Twenty random configurations are run on the first window, and the standard deviation of their
/// means defines a temperature of 1. Iteration i draws from the stream "perturb" with index i.
struct AnnealingOptions {
  static constexpr SearchWords kWords{
      .name = "annealing",
      .round = "part",
      .at_work = "searching",
      .where = "final stage",
      .candidate = "configuration",
      .no_extension =
          "annealing cannot be extended: its temperatures follow from the whole "
          "budget. Run the campaign with the larger budget into a new store"};

  std::int64_t window = 10;  ///< pairs on which configurations are compared
  std::int64_t moved = 1;    ///< pairs of the window that each iteration replaces
  Cooling cooling = Cooling::Geometric;
  double start_temperature = 1;   ///< in standard deviations of random configurations' costs
  double end_temperature = 1e-3;  ///< the same
  /// Runs of the best configuration and of the last incumbent at the end.
  std::int64_t final_runs = 100;
  bool start_at_random = false;  ///< otherwise at the smallest machine

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visitor) {
    visitor(SearchField{"window", 1, kMostRuns}, self.window);
    visitor(SearchField{"moved", 1, kMostRuns}, self.moved);
    visitor(SearchField{"start_temperature", 0, 1e6}, self.start_temperature);
    visitor(SearchField{"end_temperature", 0, 1e6}, self.end_temperature);
    visitor(SearchField{"final_runs", 1, kMostRuns}, self.final_runs);
    visitor(SearchField{.key = "cooling", .choices = kCoolingNames}, self.cooling);
    visitor(SearchField{.key = "start_at_random"}, self.start_at_random);
  }
  std::vector<SearchFault> faults() const;
  /// Without a neighbourhood, the search changes one parameter at a time, and starts at the first
  /// of the given configurations or at a random one. A budget that is too small is an error.
  Expected<std::unique_ptr<search::Strategy>> start(search::Start from) const;
  SearchPoint planned(SearchPoint point) const;
  StageTexts texts(const SearchPoint& point) const;
  friend bool operator==(const AnnealingOptions&, const AnnealingOptions&) = default;
};

namespace search {

/// Iterations of annealing that form one iteration in the events.
inline constexpr std::int64_t kAnnealingBlock = 100;

/// Whether the budget allows a further iteration before the final stage.
bool walks_on(const AnnealingOptions& options, std::int64_t budget, std::int64_t used);
/// The temperature of iteration `number`, from 1, as it is shown to the user: in the unit of the
/// options, or in score units for the published cooling.
double told_temperature(const AnnealingOptions& options, std::int64_t budget, std::int64_t used,
                        std::int64_t number);

/// A neighbourhood for any space: one active parameter gets another value, drawn uniformly; values
/// are also drawn for parameters that become active by this. `space` must outlive it.
Neighbourhood one_parameter_neighbourhood(const ParameterSpace& space, Configuration start);

}  // namespace search
}  // namespace swarmsmith
