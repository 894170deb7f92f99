#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace swarmsmith::irace {

/// A configuration that may enter the post-selection race; `missing`: how many of the pairs that
/// were seen so far it has not been tried on.
struct PostselectionCandidate {
  std::int64_t id;
  std::int64_t missing;
};

/// Who enters the post-selection race (irace facts, 14), of candidates in their order of
/// preference, best first, with `remaining` experiments: when `step` further pairs
/// (each_test * block_size) can be asked for, the first candidates that miss nothing if there are
/// enough of them to use up the budget in one step, or else the most of the first 16 whose missing
/// pairs and one step fit; when no pair is left (`step` 0), those that miss nothing and the most
/// others whose missing pairs fit. Positions among the candidates, ascending; fewer than two when
/// no race is worth it.
std::vector<std::size_t> choose_for_postselection(
    std::span<const PostselectionCandidate> candidates, std::int64_t remaining, std::int64_t step);

/// The first (in lexicographic order of positions) of the largest sets of `needs` that fit into
/// `budget`.
std::vector<std::size_t> largest_set_that_fits(std::span<const std::int64_t> needs,
                                               std::int64_t budget);

}  // namespace swarmsmith::irace
