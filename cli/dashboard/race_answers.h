#pragma once

#include "cli/dashboard/question.h"

namespace swarmsmith::cli {

/// The race of an iteration: scores by step, candidates ordered by how far they came.
Expected<Answer> race_answer(const Question& question);

/// The parameters of all elites of a design, and of a sample of its other candidates.
Expected<Answer> parameters_answer(const Question& question);

}  // namespace swarmsmith::cli
