#include "base/text/document.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <optional>

namespace swarmsmith {
namespace {

/// The parser counts lines and columns from 1, as editors do.
FilePlace place_of(const toml::source_region& region) {
  return {static_cast<std::uint32_t>(region.begin.line),
          static_cast<std::uint32_t>(region.begin.column)};
}

/// Copies the parser's tree.
Node converted(const toml::node& node) {
  const FilePlace place = place_of(node.source());
  if (const auto* flag = node.as_boolean()) return {flag->get(), place};
  if (const auto* integer = node.as_integer()) return {integer->get(), place};
  if (const auto* real = node.as_floating_point()) return {real->get(), place};
  if (const auto* text = node.as_string()) return {text->get(), place};
  if (const auto* array = node.as_array()) {
    Array items;
    for (const toml::node& item : *array)
      items.items.push_back(converted(item));
    return {std::move(items), place};
  }
  if (const auto* table = node.as_table()) {
    Table entries;
    for (const auto& [key, value] : *table) {
      entries.entries.push_back({std::string(key.str()), place_of(key.source()), converted(value)});
    }
    return {std::move(entries), place};
  }
  if (const auto* date = node.as_date()) {
    const toml::date& value = date->get();
    return {DateOrTime{std::chrono::year_month_day(std::chrono::year(value.year),
                                                   std::chrono::month(value.month),
                                                   std::chrono::day(value.day))},
            place};
  }
  return {DateOrTime{}, place};
}

/// The end of the string that begins at `at`: after its closing quotes; else at the end of the
/// line, for a string of one line, or at the end of the file.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string_view three = text.substr(at, 3);
  const bool is_long = three.size() == 3 && three[1] == quote && three[2] == quote;
  for (std::size_t i = at + (is_long ? 3 : 1); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (!is_long && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else if (is_long && text.substr(i, 3) == three) {
      i += 3;
      // Up to two more quotes belong to the string.
      while (i < text.size() && text[i] == quote)
        ++i;
      return i;
    }
  }
  return text.size();
}

/// Maximum number of levels of tables, lists and parts of keys, far more than any of the project's
/// files has. The parser, and the functions that walk its tree, recurse once for each level.
constexpr std::size_t kDeepest = 64;

/// Maximum number of values in a text, far more than any of the project's files has. The trees of
/// parser and reader take some hundred bytes for each value, and a text from outside may have one
/// value in two characters.
constexpr std::size_t kMostValues = 1'000'000;

/// The depth of the tree at each character of a file, computed from the characters outside of
/// strings and comments, without parsing. It may be too large, but never too small.
class Depth {
 public:
  void add(char letter) {
    switch (letter) {
      case '\n':
        if (open_.empty()) parts_ = 0;
        begins_line_ = true;
        return;
      case ' ':
      case '\t':
      case '\r':
        return;
      case '.':
        ++parts_;
        break;
      case ',':
        parts_ = 0;
        break;
      case '[':
      case '{':
        begin(letter);
        break;
      case ']':
      case '}':
        end();
        break;
      default:
        break;
    }
    begins_line_ = false;
  }

  std::size_t levels() const { return header_ + inside_ + parts_ + 1; }

 private:
  void begin(char letter) {
    if (open_.empty() && begins_line_ && letter == '[') {
      header_ = 0;
      in_header_ = true;
    } else if (!in_header_) {
      open_.push_back(parts_ + 1);
      inside_ += open_.back();
      parts_ = 0;
    }
  }

  void end() {
    if (in_header_) {
      header_ = parts_ + 1;
    } else if (!open_.empty()) {
      inside_ -= open_.back();
      open_.pop_back();
    }
    in_header_ = false;
    parts_ = 0;
  }

  std::vector<std::size_t> open_;  ///< levels of each open list and inline table
  std::size_t inside_ = 0;         ///< their sum
  std::size_t header_ = 0;         ///< parts of the last header: [a.b] has two
  std::size_t parts_ = 0;          ///< number of dots in the key that is being read
  bool in_header_ = false;
  bool begins_line_ = true;
};

/// A place, and the reason why it cannot be read.
struct Fault {
  FilePlace place;
  std::string reason;
};

Fault fault_at(std::string_view text, std::size_t begin, std::size_t at, std::string reason) {
  const std::string_view before = text.substr(0, at);
  const std::size_t line = before.rfind('\n');
  const std::size_t column = line == std::string_view::npos ? at - begin : at - line - 1;
  return {{static_cast<std::uint32_t>(1 + std::ranges::count(before, '\n')),
           static_cast<std::uint32_t>(1 + column)},
          std::move(reason)};
}

/// The first thing that the parser must not see. First, non-ASCII characters outside of strings and
/// comments: TOML has none there, and what the parser does with them is undefined (toml++ 3.3).
/// Second, a depth that would need more stack than there is. Third, more values than memory should
/// be used for. Each value and level comes after a character that is counted.
std::optional<Fault> fault_of(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  const std::size_t begin = text.starts_with(kMark) ? kMark.size() : 0;
  Depth depth;
  std::size_t values = 0;
  for (std::size_t i = begin; i < text.size();) {
    if (static_cast<unsigned char>(text[i]) >= 0x80) {
      return fault_at(text, begin, i,
                      "letters such as umlauts are allowed only in quotes or comments");
    }
    depth.add(text[i]);
    if (depth.levels() > kDeepest) {
      return fault_at(text, begin, i,
                      "keys, tables and lists are nested deeper than " + std::to_string(kDeepest) +
                          " levels here");
    }
    if (std::string_view("=,[{").find(text[i]) != std::string_view::npos) ++values;
    if (values > kMostValues) {
      return fault_at(text, begin, i, "more than " + std::to_string(kMostValues) + " values");
    }
    if (text[i] == '"' || text[i] == '\'') {
      i = end_of_string(text, i);
    } else if (text[i] == '#') {
      i = std::min(text.find('\n', i), text.size());
    } else {
      ++i;
    }
  }
  return std::nullopt;
}

}  // namespace

std::string_view type_name(const Node& node) {
  static constexpr std::array<std::string_view, 7> kNames = {
      "true or false", "an integer", "a number", "a text", "a list", "a table", "a date or time"};
  return kNames[node.value.index()];
}

std::string to_string(std::string_view file, FilePlace place) {
  std::string text(file);
  if (place.line > 0) {
    text += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  }
  return text;
}

Expected<Node> parse_document(std::string_view text, std::string_view file) {
  if (const auto fault = fault_of(text)) {
    return bad_input("this is not TOML: " + fault->reason, to_string(file, fault->place));
  }
  try {
    return converted(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    return bad_input("this is not TOML: " + std::string(error.description()),
                     to_string(file, place_of(error.source())));
  }
}

}  // namespace swarmsmith
