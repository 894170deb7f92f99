#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// Replaces ids as commands print them by numbers, where the statement compares them with a column
/// of such ids: `candidate = 'c812'` becomes `candidate = 812`. These columns hold numbers, and SQL
/// would find no rows and give no error. Everything else stays as it is, also broken SQL.
std::string with_numbers_of_ids(std::string_view sql);

}  // namespace swarmsmith
