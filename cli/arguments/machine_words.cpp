#include "cli/arguments/machine_words.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

#include "sim/control/controller.h"

namespace swarmsmith::cli {
namespace {

/// Whether the argument is the first one of a machine's text, or all of it. Before the text there
/// may be options of another program.
bool begins_machine(std::string_view word) {
  if (!word.starts_with("--")) return false;
  const bool is_whole = word.find(' ') != std::string_view::npos;
  return architecture_of_text(word).has_value() ||
         (is_whole && find_controller(word) != std::string_view::npos);
}

/// Whether the argument is a switch of one of the grammars: letters, which a flavour may choose,
/// followed by digits or DIGITSxDIGITS (no option of this program looks like that); or a switch
/// that only trees and networks have.
bool is_machine_switch(std::string_view word) {
  static constexpr std::array<std::string_view, 3> kWhole = {"--nchildroot", "--nchildsroot",
                                                             "--weights"};
  if (begins_machine(word) || std::ranges::find(kWhole, word) != kWhole.end()) return true;
  if (!word.starts_with("--")) return false;
  word.remove_prefix(2);
  const auto is_letter = [](char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); };
  const auto digits = std::ranges::find_if_not(word, is_letter);
  if (digits == word.begin()) return false;
  const std::string_view suffix(digits, word.end());
  if (suffix.empty() || suffix.front() == 'x' || suffix.back() == 'x') return false;
  return suffix.find_first_not_of("0123456789x") == std::string_view::npos &&
         std::ranges::count(suffix, 'x') <= 1;
}

}  // namespace

std::vector<std::string> with_machine_as_one_word(std::vector<std::string> words) {
  std::vector<std::string> changed;
  std::size_t i = 0;
  while (i < words.size() && words[i] != "--" && !begins_machine(words[i])) {
    changed.push_back(words[i++]);
  }
  if (i == words.size()) return changed;
  const bool everything = words[i] == "--";
  if (everything) ++i;
  std::string machine;
  // Each switch has a value, so only the argument after a value must be a switch.
  bool value_next = false;
  for (; i < words.size(); ++i) {
    if (!everything && !value_next && !is_machine_switch(words[i])) break;
    const bool whole_text = words[i].find(' ') != std::string::npos;
    value_next =
        !value_next && !whole_text && words[i] != "--fsm-config" && words[i] != "--bt-config";
    machine += " " + words[i];
  }
  changed.push_back(std::move(machine));
  changed.insert(changed.end(), words.begin() + static_cast<std::ptrdiff_t>(i), words.end());
  return changed;
}

}  // namespace swarmsmith::cli
