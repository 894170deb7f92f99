#pragma once

#include <string>
#include <vector>

#include "analysis/comparison/comparison.h"

namespace swarmsmith {

/// What a comparison found, as a sentence of a paper: who, n, means, test, p, effect and interval.
struct PaperSentence {
  std::string text;
  std::string latex;  ///< the same, for LaTeX: mathematics between dollar signs, names escaped
};

/// One for each pair. Of a comparison without pairs one for each group: mean, spread, n. A
/// difference is called one when p by Holm is below 0.05.
std::vector<PaperSentence> paper_sentences(const Comparison& comparison);

}  // namespace swarmsmith
