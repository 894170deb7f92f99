#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "irace_core/search/options.h"

namespace swarmsmith {

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

/// The part that the search is in: "generation 41", "final stage", "one race".
std::string round_name(const SearchOptions& options, const SearchPoint& known);
/// What it begins with: "generation 41 of 90: 20 members, 5 runs each".
std::string round_line(const SearchOptions& options, const SearchPoint& known);
/// Where the search is: "generation 41 of 90, 12 of 20 members", "configuration 310 of 900",
/// "iteration 812, temperature 0.0312", "one race: 17 left", "final stage: 12 of 20 members".
/// Empty before the first iteration. What no event has said yet follows from options and budget,
/// as in a campaign that was continued.
std::string stage_text(const SearchOptions& options, const SearchPoint& known);

}  // namespace swarmsmith
