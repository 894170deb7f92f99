#pragma once

#include "cli/dashboard/question.h"

namespace swarmsmith::cli {

/// Who raced in an iteration: scores by step, candidates in the order of how far they came.
Expected<Answer> race_answer(const Question& question);

/// Parameters of a sample of a design's candidates, and of all its elites.
Expected<Answer> parameters_answer(const Question& question);

}  // namespace swarmsmith::cli
