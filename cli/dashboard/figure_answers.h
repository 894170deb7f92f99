#pragma once

#include "cli/dashboard/question.h"

namespace swarmsmith::cli {

/// A figure as `figure` writes it; the id is "box.svg" or "box.csv".
/// {"v":1,"nothing":"..."} where there is nothing to draw yet, with what to do.
Expected<Answer> figure_answer(const Question& question);

/// Tests of sources or methods as `compare --csv` has them; the id is "pairs.csv" or "groups.csv".
Expected<Answer> comparison_answer(const Question& question);

}  // namespace swarmsmith::cli
