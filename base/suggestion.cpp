#include "base/suggestion.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace swarmsmith {
namespace {

char folded(char letter) {
  if (letter == '-' || letter == ' ') return '_';
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

constexpr std::size_t kEdit = 2;

/// The cost of adding or leaving out a letter; a dash costs half.
std::size_t cost_of(char letter) {
  return folded(letter) == '_' ? kEdit / 2 : kEdit;
}

/// Optimal string alignment distance: edits and swaps of neighbours cost kEdit each.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 1; i <= a.size(); ++i)
    rows[i][0] = rows[i - 1][0] + cost_of(a[i - 1]);
  for (std::size_t j = 1; j <= b.size(); ++j)
    rows[0][j] = rows[0][j - 1] + cost_of(b[j - 1]);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = folded(a[i - 1]) == folded(b[j - 1]);
      rows[i][j] = std::min({rows[i - 1][j] + cost_of(a[i - 1]), rows[i][j - 1] + cost_of(b[j - 1]),
                             rows[i - 1][j - 1] + (same ? 0 : kEdit)});
      const bool swapped = i > 1 && j > 1 && folded(a[i - 1]) == folded(b[j - 2]) &&
                           folded(a[i - 2]) == folded(b[j - 1]);
      if (swapped) rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + kEdit);
    }
  }
  return rows[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> closest(std::string_view word, std::span<const std::string> known) {
  const std::size_t tolerated = kEdit * std::max<std::size_t>(1, word.size() / 3);
  std::size_t best = tolerated + 1;
  std::optional<std::string> found;
  for (const std::string& candidate : known) {
    const std::size_t edits = distance(word, candidate);
    if (edits >= best || edits >= kEdit * std::max(word.size(), candidate.size())) continue;
    best = edits;
    found = candidate;
  }
  return found;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
  const auto found = closest(word, known);
  return found ? " (did you mean \"" + *found + "\"?)" : std::string();
}

std::string joined(std::span<const std::string> words) {
  const bool quotes = std::ranges::any_of(
      words, [](const std::string& word) { return word.find(',') != std::string::npos; });
  const std::string quote = quotes ? "\"" : "";
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ", ";
    text += quote;
    text += word;
    text += quote;
  }
  return text;
}

}  // namespace swarmsmith
