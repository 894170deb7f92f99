#pragma once

#include "cli/dashboard/question.h"

namespace swarmsmith::cli {

/// A figure as `figure` writes it; the id is "box.svg" or "box.csv".
Expected<Answer> figure_answer(const Question& question);

}  // namespace swarmsmith::cli
