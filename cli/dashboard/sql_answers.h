#pragma once

#include <chrono>

#include "cli/dashboard/question.h"

namespace swarmsmith::cli {

/// Limits for a statement that a person types into a page.
inline constexpr std::int64_t kSqlRows = 10'000;
inline constexpr std::int64_t kSqlSeconds = 10;
inline constexpr std::size_t kSqlBytes = std::size_t{8} << 20U;

/// Runs a user's statement in a separate process, `program query`. The process is stopped when its
/// time is over, when the answer is too long, or when the client disconnects, so the statement
/// cannot slow down the campaign's process.
Expected<Answer> sql_answer(const Question& question, const std::string& program);

}  // namespace swarmsmith::cli
