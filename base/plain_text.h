#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// The parts of a text between separators: one more than there are separators, so that an empty
/// text has one part, which is empty.
inline std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// The lines of a text, without their line ends. The last line may have no line end.
inline std::vector<std::string_view> split_lines(std::string_view text) {
  auto lines = split(text, '\n');
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

/// "1 worker", "2 workers"; `several` is a plural without -s: "2 patches".
std::string counted(std::integral auto count, std::string_view what,
                    std::string_view several = {}) {
  std::string text = std::to_string(count) + " ";
  if (count == 1) return text.append(what);
  return several.empty() ? text.append(what) + "s" : text.append(several);
}

/// A word of a command in a message, such as a file's name: in quotes for a shell where it needs
/// them.
inline std::string command_word(std::string_view word) {
  constexpr std::string_view kUnquoted =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:@%+=,";
  if (!word.empty() && word.find_first_not_of(kUnquoted) == std::string_view::npos)
    return std::string(word);
  std::string quoted = "'";
  for (const char letter : word)
    quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

}  // namespace swarmsmith
