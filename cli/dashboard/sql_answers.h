#pragma once

#include <chrono>

#include "cli/dashboard/question.h"

namespace swarmsmith::cli {

/// The most of a statement that a person types into a page.
inline constexpr std::int64_t kSqlRows = 10'000;
inline constexpr std::int64_t kSqlSeconds = 10;
inline constexpr std::size_t kSqlBytes = std::size_t{8} << 20U;

/// Runs a person's statement in a process of its own, `program query`, that ends with its time,
/// with too long an answer, or when the client disconnects: whatever it needs, the campaign's
/// process does not feel it.
Expected<Answer> sql_answer(const Question& question, const std::string& program);

}  // namespace swarmsmith::cli
