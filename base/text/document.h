#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A TOML text as plain values with their places. The parser's headers are needed in only one file.

/// Line and column in the text, both from 1; 0 for a value that is not in the text.
struct FilePlace {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

struct Node;

/// A table's keys in alphabetical order.
struct Table {
  struct Entry;
  std::vector<Entry> entries;
};

struct Array {
  std::vector<Node> items;
};

/// A date; empty for a time, which no key of the project takes.
struct DateOrTime {
  std::optional<std::chrono::year_month_day> date;
};

struct Node {
  std::variant<bool, std::int64_t, double, std::string, Array, Table, DateOrTime> value;
  FilePlace place;
};

struct Table::Entry {
  std::string key;
  FilePlace place;  ///< of the key
  Node node;
};

/// The node's type in words: "a text", "an integer", ...
std::string_view type_name(const Node& node);

/// A place in the form that users and editors know: file:line:column.
std::string to_string(std::string_view file, FilePlace place);

/// Parses the text; `file` is its name in errors.
Expected<Node> parse_document(std::string_view text, std::string_view file);

}  // namespace swarmsmith
