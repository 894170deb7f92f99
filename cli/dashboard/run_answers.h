#pragma once

#include "cli/dashboard/question.h"

namespace swarmsmith::cli {

/// A run, cycle by cycle: an evaluation (e81200007) or a candidate on a seed (c812-7), simulated
/// again and compared with the store; or a real run (r7), as it was measured.
Expected<Answer> trajectory_answer(const Question& question);

/// The same run as a table, with the same bytes as `replay --csv`.
Expected<Answer> trajectory_csv_answer(const Question& question);

}  // namespace swarmsmith::cli
