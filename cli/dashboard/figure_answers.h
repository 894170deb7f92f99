#pragma once

#include "cli/dashboard/question.h"

namespace swarmsmith::cli {

/// A figure as `figure` writes it; the id is "box.svg" or "box.csv".
/// {"v":1,"nothing":"..."} if there is nothing to draw yet, with advice on what to do.
Expected<Answer> figure_answer(const Question& question);

/// Statistical tests of sources or methods as in `compare --csv`; the id is "pairs.csv" or
/// "groups.csv".
Expected<Answer> comparison_answer(const Question& question);

}  // namespace swarmsmith::cli
