#pragma once

#include <string>
#include <vector>

#include "analysis/comparison/comparison.h"

namespace swarmsmith {

/// A result of a comparison as a sentence for a paper: names, n, means, test, p, effect and
/// interval.
struct PaperSentence {
  std::string text;
  std::string latex;  ///< the same for LaTeX: mathematics between dollar signs, names escaped
};

/// One sentence per pair. For a comparison without pairs, one per group: mean, spread, n. The
/// sentence reports a difference if Holm's p is below 0.05.
std::vector<PaperSentence> paper_sentences(const Comparison& comparison);

}  // namespace swarmsmith
