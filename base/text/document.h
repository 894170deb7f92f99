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

/// A TOML text as plain values with places, so that one file includes the parser's headers.

/// Line and column in the text, both from 1; 0 for what is not in it.
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

/// A date, or nothing: a time, which no key of ours takes.
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

/// "a text", "an integer", ...: what a person calls the node's type.
std::string_view type_name(const Node& node);

/// Where `place` is, as people and editors write it: file:line:column.
std::string to_string(std::string_view file, FilePlace place);

/// Parses the text; `file` is its name in errors.
Expected<Node> parse_document(std::string_view text, std::string_view file);

}  // namespace swarmsmith
