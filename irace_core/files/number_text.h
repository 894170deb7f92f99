#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swarmsmith {

/// The number that a text is as a whole, in decimal or hexadecimal, with an exponent and R's
/// suffix L; nothing for what is none, is not finite or has blanks.
std::optional<double> number_of(std::string_view text);

/// The shortest decimal text that reads back to the same number.
std::string shortest_text(double number);

/// In double quotes, with backslashes before quotes and backslashes, and \n and \t for what they
/// stand for: a text of R.
std::string quoted_in_r(std::string_view text);

}  // namespace swarmsmith
