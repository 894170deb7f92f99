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
  Published,  ///< from 125 score units, halved every third iteration, again and again
};

inline constexpr std::array<std::string_view, 2> kCoolingNames = {"geometric", "published"};

/// Simulated annealing in the manner of IcePop (docs/methods.md). A window of pairs moves on with
/// each iteration: the incumbent and the best so far are run on its new pairs, the perturbed
/// configuration on all. It is accepted when it is not worse by the window's mean, else with the
/// probability exp(-loss / T); T = 0 throughout is iterative improvement. All runs count. The best
/// and the last incumbent are run again at the end on further pairs, and the better mean wins.
///
/// Twenty random configurations on the first window say what a temperature of 1 is: the standard
/// deviation of their means. Iteration i draws from the stream "perturb" with index i.
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

  std::int64_t window = 10;  ///< pairs on which machines are compared
  std::int64_t moved = 1;    ///< pairs of the window that each iteration replaces
  Cooling cooling = Cooling::Geometric;
  double start_temperature = 1;   ///< in standard deviations of random configurations' costs
  double end_temperature = 1e-3;  ///< the same
  std::int64_t final_runs = 100;  ///< of the best and the last
  bool start_at_random = false;   ///< else at the smallest machine

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
  /// Without a neighbourhood, it changes one parameter at a time from the first of the given
  /// configurations or a random one. Errors: a budget that is too small.
  Expected<std::unique_ptr<search::Strategy>> start(search::Start from) const;
  SearchPoint planned(SearchPoint point) const;
  StageTexts texts(const SearchPoint& point) const;
  friend bool operator==(const AnnealingOptions&, const AnnealingOptions&) = default;
};

namespace search {

inline constexpr std::int64_t kAnnealingBlock = 100;  ///< iterations of it in one of the events

/// Whether there is room for a further iteration before the final stage.
bool walks_on(const AnnealingOptions& options, std::int64_t budget, std::int64_t used);
/// The temperature of iteration `number`, from 1, as it is shown: in the unit of the
/// options, and in score units where it is the published one.
double told_temperature(const AnnealingOptions& options, std::int64_t budget, std::int64_t used,
                        std::int64_t number);

/// The neighbourhood of any space: one active parameter gets another value, drawn uniformly;
/// parameters that become active with it are drawn, too. `space` must outlive it.
Neighbourhood one_parameter_neighbourhood(const ParameterSpace& space, Configuration start);

}  // namespace search
}  // namespace swarmsmith
