#include "storage/internal/machine_parts.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <map>
#include <new>
#include <set>
#include <utility>
#include <vector>

namespace swarmsmith {
namespace {

bool is_digit(std::string_view text, std::size_t at) {
  return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

/// The number at the beginning of the text, like 0 + text in SQL.
std::int64_t number_at(std::string_view text) {
  std::int64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// A word of the text such as "n0x1 2": its owner (the number after the letter), and its value.
struct Word {
  std::string_view text;

  std::int64_t owner() const { return number_at(text.substr(1)); }
  std::int64_t value() const {
    const std::size_t blank = text.find(' ');
    return blank == std::string_view::npos ? 0 : number_at(text.substr(blank + 1));
  }
  bool begins(char letter) const { return text.front() == letter && is_digit(text, 1); }
  /// GLOB '?[0-9]*x[0-9]*'
  bool is_of_transition() const {
    for (std::size_t i = 2; i < text.size(); ++i)
      if (text[i] == 'x' && is_digit(text, i + 1)) return true;
    return false;
  }
  /// GLOB '?[0-9][0-9] *'
  bool is_of_subtree() const { return is_digit(text, 2) && text.size() > 3 && text[3] == ' '; }
};

template <class OnWord>
void each_word(std::string_view text, OnWord on_word) {
  constexpr std::string_view kBetween = " --";
  text.remove_prefix(std::min<std::size_t>(2, text.size()));
  while (true) {
    const std::size_t end = text.find(kBetween);
    if (const Word word{text.substr(0, end)}; !word.text.empty()) on_word(word);
    if (end == std::string_view::npos) return;
    text.remove_prefix(end + kBetween.size());
  }
}

std::set<std::int64_t> reached_of(std::string_view text) {
  std::vector<std::pair<std::int64_t, std::int64_t>> ways;
  each_word(text, [&](const Word& word) {
    if (!word.begins('n') || !word.is_of_transition()) return;
    const std::int64_t from = word.owner();
    const std::int64_t jump = word.value();
    ways.emplace_back(from, jump + (jump >= from ? 1 : 0));
  });
  std::ranges::sort(ways);
  std::set<std::int64_t> reached{0};
  std::vector<std::int64_t> open{0};
  while (!open.empty()) {
    const std::int64_t state = open.back();
    open.pop_back();
    for (auto way = std::ranges::lower_bound(ways, std::pair(state, INT64_MIN));
         way != ways.end() && way->first == state; ++way)
      if (reached.insert(way->second).second) open.push_back(way->second);
  }
  return reached;
}

/// 's' or 'c' for a word that names a module, else 0.
char kind_of(const Word& word) {
  if (word.begins('s')) return 's';
  if (word.begins('c') && (word.is_of_transition() || word.is_of_subtree())) return 'c';
  return word.begins('a') && word.is_of_subtree() ? 's' : '\0';
}

using Function = std::string (*)(std::string_view);

template <Function function>
void answer(sqlite3_context* context, int, sqlite3_value** values) {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_value_text(values[0]));
  if (bytes == nullptr) return sqlite3_result_null(context);
  const auto size = static_cast<std::size_t>(sqlite3_value_bytes(values[0]));
  try {
    const std::string text = function({bytes, size});
    sqlite3_result_text(context, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  } catch (const std::bad_alloc&) {
    sqlite3_result_error_nomem(context);
  }
}

}  // namespace

std::string reached_states(std::string_view text) {
  std::string list = " ";
  for (const std::int64_t state : reached_of(text))
    fmt::format_to(std::back_inserter(list), "{} ", state);
  return list;
}

std::string module_counts(std::string_view text) {
  const bool is_tree = text.starts_with("--nroot");
  const std::set<std::int64_t> reached = reached_of(text);
  std::map<std::pair<char, std::int64_t>, std::pair<int, int>> counts;
  each_word(text, [&](const Word& word) {
    const char kind = kind_of(word);
    if (kind == '\0') return;
    auto& [all, reachable] = counts[{kind, word.value()}];
    ++all;
    if (is_tree || reached.contains(word.owner())) ++reachable;
  });
  std::string json = "{";
  for (const auto& [module, count] : counts) {
    fmt::format_to(std::back_inserter(json), "{}\"{}{}\":\"{} {}\"", json.size() > 1 ? "," : "",
                   module.first, module.second, count.first, count.second);
  }
  return json + "}";
}

void add_machine_functions(const sqlite::Connection& connection) {
  const auto add = [&](const char* name, auto* function) {
    constexpr int kFlags = SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS;
    const int code = sqlite3_create_function_v2(connection.handle(), name, 1, kFlags, nullptr,
                                                function, nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) connection.fail(code);
  };
  add("reached_states", &answer<&reached_states>);
  add("module_counts", &answer<&module_counts>);
}

}  // namespace swarmsmith
