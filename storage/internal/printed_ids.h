#pragma once

#include <string>
#include <string_view>

namespace swarmsmith {

/// The statement with numbers in place of ids as commands print them, where it compares them with a
/// column of such ids: `candidate = 'c812'` becomes `candidate = 812`. Such columns hold numbers,
/// and SQL would find nothing and say nothing. Everything else stays as it is, broken SQL too.
std::string with_numbers_of_ids(std::string_view sql);

}  // namespace swarmsmith
