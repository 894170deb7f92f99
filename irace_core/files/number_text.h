#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace swarmsmith {

/// The number if the whole text is a number, in decimal or hexadecimal, possibly with an exponent
/// and R's suffix L; nothing for any other text, for a number that is not finite, and if there are
/// blanks.
std::optional<double> number_of(std::string_view text);

/// The shortest decimal text from which the same number is read back.
std::string shortest_text(double number);

/// The text as a string of R: in double quotes, with backslashes before quotes and backslashes, and
/// \n and \t for line ends and tabs.
std::string quoted_in_r(std::string_view text);

}  // namespace swarmsmith
