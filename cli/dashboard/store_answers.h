#pragma once

#include "cli/dashboard/question.h"

namespace swarmsmith::cli {

/// Answers about a store as a whole, its designs and its candidates.

Expected<Answer> campaign_answer(const Question& question);
Expected<Answer> events_answer(const Question& question);
Expected<Answer> convergence_answer(const Question& question);
Expected<Answer> design_answer(const Question& question);
Expected<Answer> steps_answer(const Question& question);
Expected<Answer> candidate_answer(const Question& question);
Expected<Answer> evaluation_answer(const Question& question);
Expected<Answer> scores_answer(const Question& question);
Expected<Answer> leaderboard_answer(const Question& question);
Expected<Answer> modules_answer(const Question& question);
Expected<Answer> real_runs_answer(const Question& question);
Expected<Answer> views_answer(const Question& question);

/// The workers in the store, with the field names of `live`.
Expected<std::vector<JsonPiece>> stored_workers(StoreReader& store, bool is_written);

}  // namespace swarmsmith::cli
