#pragma once

#include <string>

#include "irace_core/search/options.h"

namespace swarmsmith {

/// The part in which the search is: "generation 41", "final stage", "one race".
std::string round_name(const SearchOptions& options, const SearchPoint& known);
/// The line that is printed when a part begins: "generation 41 of 90: 20 members, 5 runs each".
std::string round_line(const SearchOptions& options, const SearchPoint& known);
/// The progress of the search: "generation 41 of 90, 12 of 20 members", "configuration 310 of 900",
/// "iteration 812, temperature 0.0312", "one race: 17 left", "final stage: 12 of 20 members". Empty
/// before the first iteration. Numbers that no event has reported yet are computed from options and
/// budget, for instance in a campaign that was continued.
std::string stage_text(const SearchOptions& options, const SearchPoint& known);

}  // namespace swarmsmith
