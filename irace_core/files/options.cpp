#include "irace_core/files/options.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/overloaded.h"
#include "base/plain_text.h"
#include "base/suggestion.h"
#include "irace_core/expression.h"
#include "irace_core/files/number_text.h"

namespace swarmsmith {
namespace {

/// Larger whole numbers are not exact as doubles, which are R's numbers.
constexpr double kLargestWhole = 9007199254740992.0;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

/// first_test becomes firstTest.
std::string camel_case(std::string_view name) {
  std::string option;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool joins = name[i] == '_' && i + 1 < name.size();
    if (joins) ++i;
    option +=
        joins ? static_cast<char>(std::toupper(static_cast<unsigned char>(name[i]))) : name[i];
  }
  return option;
}

std::string found(std::string_view text) {
  return ", found \"" + std::string(text) + "\"";
}

Expected<IraceValue> bool_of(std::string_view text) {
  const std::string word = lower_case(text);
  if (word == "1" || word == "true" || word == "t") return true;
  if (word == "0" || word == "false" || word == "f") return false;
  return bad_input("must be 0 or 1" + found(text));
}

Expected<IraceValue> natural_of(std::string_view text) {
  const std::optional<double> number = number_of(text);
  if (!number || *number < 0 || *number != std::floor(*number) || *number > kLargestWhole) {
    return bad_input("must be a whole number, 0 or more" + found(text));
  }
  return static_cast<std::int64_t>(*number);
}

Expected<IraceValue> real_of(std::string_view text) {
  const std::optional<double> number = number_of(text);
  if (!number || !(*number >= 0 && *number <= 1)) {
    return bad_input("must be a number from 0 to 1" + found(text));
  }
  return *number;
}

Expected<IraceValue> choice_of(const IraceOption& option, std::string_view text) {
  for (const std::string_view choice : split(option.words, ',')) {
    const std::vector<std::string_view> names = split(choice, '|');
    for (const std::string_view name : names) {
      if (lower_case(name) == lower_case(text)) return std::string(names.front());
    }
  }
  const std::vector<std::string> words = irace_words(option);
  return bad_input("must be one of " + joined(words) + found(text) + did_you_mean(text, words));
}

}  // namespace

bool IraceOption::takes_value() const {
  return kind != IraceKind::Action && kind != IraceKind::Flag;
}

bool IraceOption::is_path() const {
  return kind == IraceKind::File || kind == IraceKind::Folder || kind == IraceKind::Program;
}

const IraceOption* find_irace_option(std::string_view name) {
  if (name.empty()) return nullptr;
  const auto options = irace_options();
  const auto found = std::ranges::find(options, name, &IraceOption::name);
  return found == options.end() ? nullptr : &*found;
}

const IraceOption* find_irace_switch(std::string_view word) {
  if (word.empty()) return nullptr;
  for (const IraceOption& option : irace_options()) {
    if (option.short_switch == word || option.long_switch == word) return &option;
  }
  return nullptr;
}

std::vector<std::string> irace_option_names() {
  std::vector<std::string> names;
  for (const IraceOption& option : irace_options()) {
    if (!option.name.empty()) names.emplace_back(option.name);
  }
  return names;
}

std::vector<std::string> irace_switches() {
  std::vector<std::string> words;
  for (const IraceOption& option : irace_options()) {
    if (!option.long_switch.empty()) words.emplace_back(option.long_switch);
  }
  return words;
}

std::vector<std::string> irace_words(const IraceOption& option) {
  std::vector<std::string> words;
  for (const std::string_view choice : split(option.words, ',')) {
    words.emplace_back(choice.substr(0, choice.find('|')));
  }
  return words;
}

std::string with_irace_option_names(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto is_letter = [](char c) {
      return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
    };
    const auto end = std::find_if_not(text.begin(), text.end(), is_letter);
    const std::string_view word = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    const std::string option = camel_case(word);
    result += find_irace_option(option) != nullptr ? option : std::string(word);
    text.remove_prefix(word.size());
    if (text.empty()) break;
    result += text.front();
    text.remove_prefix(1);
  }
  return result;
}

Error with_irace_option_names(const Error& error) {
  return {error.kind, with_irace_option_names(error.message), with_irace_option_names(error.where)};
}

Expected<IraceValue> irace_value_of(const IraceOption& option, std::string_view text) {
  const bool is_text = option.is_path() || option.kind == IraceKind::Text ||
                       option.kind == IraceKind::Texts || option.kind == IraceKind::Anything;
  if (!is_text && (text.empty() || text == "NA")) return IraceValue{};
  switch (option.kind) {
    case IraceKind::Action:
    case IraceKind::Flag:
    case IraceKind::Bool:
      return bool_of(text);
    case IraceKind::Natural:
      return natural_of(text);
    case IraceKind::Real:
      return real_of(text);
    case IraceKind::Choice:
      return choice_of(option, text);
    case IraceKind::Texts:
      return std::vector<std::string>{std::string(text)};
    case IraceKind::Text:
    case IraceKind::File:
    case IraceKind::Folder:
    case IraceKind::Program:
    case IraceKind::Anything:
      return std::string(text);
  }
  return IraceValue{};
}

std::string irace_value_text(const IraceValue& value) {
  return std::visit(Overloaded{
                        [](std::monostate) { return std::string("NULL"); },
                        [](bool on) { return std::string(on ? "1" : "0"); },
                        [](std::int64_t number) { return std::to_string(number); },
                        [](double number) { return shortest_text(number); },
                        [](const std::string& text) { return quoted_in_r(text); },
                        [](const std::vector<std::string>& texts) {
                          std::string list;
                          for (const std::string& text : texts)
                            list += (list.empty() ? "" : ", ") + quoted_in_r(text);
                          return "c(" + list + ")";
                        },
                    },
                    value);
}

}  // namespace swarmsmith
