#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace swarmsmith {

/// The known word that a person who typed `word` may have meant: the one with the smallest number
/// of inserted, dropped, replaced or swapped letters, unless that is more than a third of the word
/// (and more than one). Letters are compared without case, `-` equals `_`. The first of equals.
std::optional<std::string> closest(std::string_view word, std::span<const std::string> known);

/// ` (did you mean "seed"?)`, or nothing: to be put behind what was found.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

/// `a, b, c`; in quotes where one of them holds a comma.
std::string joined(std::span<const std::string> words);

}  // namespace swarmsmith
