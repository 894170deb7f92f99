#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace swarmsmith {

/// The known word that a user who typed `word` may have meant: the one with the smallest number of
/// inserted, dropped, replaced or swapped letters, unless that is more than a third of the word
/// (and more than one). Upper and lower case count as equal, and so do `-` and `_`. Of several
/// equally near words, the first.
std::optional<std::string> closest(std::string_view word, std::span<const std::string> known);

/// ` (did you mean "seed"?)`, or an empty text; to be appended to a message.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

/// `a, b, c`; in quotes if one of them contains a comma.
std::string joined(std::span<const std::string> words);

}  // namespace swarmsmith
