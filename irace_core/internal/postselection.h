#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace swarmsmith::irace {

/// A configuration that may enter the post-selection race; `missing` is the number of pairs used so
/// far on which it has not been tried.
struct PostselectionCandidate {
  std::int64_t id;
  std::int64_t missing;
};

/// Chooses the configurations that enter the post-selection race (irace facts, 14). The candidates
/// are in order of preference, best first; `remaining` experiments are left. If `step` further
/// pairs (each_test * block_size) are available: the first candidates that miss no pair, if there
/// are enough of them to use up the budget in one step; otherwise as many as possible of the first
/// 16 candidates whose missing pairs and one step fit into the budget. If no pairs are left (`step`
/// 0): the candidates that miss no pair, and as many as possible of the others whose missing pairs
/// fit. Returns positions among the candidates, ascending; fewer than two if a race is not
/// worthwhile.
std::vector<std::size_t> choose_for_postselection(
    std::span<const PostselectionCandidate> candidates, std::int64_t remaining, std::int64_t step);

/// The largest set of `needs` whose sum fits into `budget`; of several, the first in lexicographic
/// order of positions.
std::vector<std::size_t> largest_set_that_fits(std::span<const std::int64_t> needs,
                                               std::int64_t budget);

}  // namespace swarmsmith::irace
