#include "base/text/table_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <system_error>
#include <tuple>

#include "base/plain_text.h"
#include "base/shown_text.h"
#include "base/suggestion.h"
#include "base/text/toml_text.h"

namespace swarmsmith {
namespace {

/// The table of a node; readers exist only for tables.
const Table& entries_of(const Node& node) {
  return std::get<Table>(node.value);
}

struct Unit {
  std::string_view name;
  double seconds;
};
constexpr std::array<Unit, 4> kUnits = {{{"ms", 0.001}, {"s", 1}, {"min", 60}, {"h", 3600}}};

/// Users write numbers as integers or as reals.
std::optional<double> as_number(const Node& node) {
  if (const auto* real = std::get_if<double>(&node.value)) return *real;
  if (const auto* whole = std::get_if<std::int64_t>(&node.value)) {
    return static_cast<double>(*whole);
  }
  return std::nullopt;
}

/// Both ends belong to the range.
template <class Number>
bool within(Number value, Limits<Number> limits) {
  return value >= limits.least && value <= limits.most;
}

/// Names are in tables and figures, and stores refuse longer ones.
constexpr std::size_t kLongestName = 1000;

/// A key from the file, short enough for a message.
std::string shown_key(std::string_view key) {
  constexpr std::size_t kLongest = 60;
  std::string shown = as_shown(key.substr(0, kLongest), Layout::Escaped);
  return "`" + shown + (key.size() > kLongest ? "...`" : "`");
}

/// "at least 1", "from 0 to 1".
std::string range_text(Limits<double> limits) {
  if (limits.most >= 9e15) return "at least " + number_text(limits.least);
  return "from " + number_text(limits.least) + " to " + number_text(limits.most);
}

}  // namespace

std::optional<double> parse_seconds(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  while (!unit.empty() && unit.front() == ' ')
    unit.remove_prefix(1);
  for (const Unit& known : kUnits) {
    if (unit == known.name) return value * known.seconds;
  }
  return std::nullopt;
}

void Complaints::add(FilePlace place, std::string message) {
  add_foreign(place, Error{ErrorKind::BadInput, std::move(message), to_string(file_, place)});
}

void Complaints::add_foreign(FilePlace place, Error error) {
  complaints_.emplace_back(place, std::move(error));
}

std::vector<Error> Complaints::take() {
  std::ranges::stable_sort(complaints_, {}, [](const auto& complaint) {
    const FilePlace place = complaint.first;
    return std::tuple(place.line == 0, place.line, place.column);
  });
  std::vector<Error> errors;
  for (auto& [place, error] : complaints_)
    errors.push_back(std::move(error));
  complaints_.clear();
  return errors;
}

TableReader::TableReader(const Node& table, std::string path, Complaints& complaints, bool in_list)
    : table_(&table), path_(std::move(path)), in_list_(in_list), complaints_(&complaints) {}

std::string TableReader::name() const {
  if (path_.empty()) return "the file";
  return in_list_ ? "[[" + path_ + "]]" : "[" + path_ + "]";
}

std::string TableReader::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

const Table::Entry* TableReader::find(std::string_view key) const {
  for (const Table::Entry& entry : entries_of(*table_).entries) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

FilePlace TableReader::place_of(std::string_view key) const {
  const Table::Entry* entry = find(key);
  return entry != nullptr ? entry->node.place : table_->place;
}

void TableReader::complain(std::string_view key, std::string message) {
  complaints_->add(place_of(key), std::move(message));
}

void TableReader::complain_foreign(std::string_view key, Error error) {
  // A missing file has no line to report: its name is the error.
  if (error.kind == ErrorKind::NotFound) return complain(key, error.where + ": " + error.message);
  complaints_->add_foreign(place_of(key), std::move(error));
}

/// Complains about a value of another type than the key needs.
void TableReader::complain_type(const Node& node, std::string_view key, std::string_view wanted) {
  complaints_->add(node.place, "`" + std::string(key) + "` must be " + std::string(wanted) +
                                   ", not " + std::string(type_name(node)));
}

const Node* TableReader::take(std::string_view key) {
  asked_.emplace(key);
  const Table::Entry* entry = find(key);
  return entry != nullptr ? &entry->node : nullptr;
}

std::vector<std::pair<std::string, const Node*>> TableReader::take_all() {
  std::vector<std::pair<std::string, const Node*>> all;
  for (const Table::Entry& entry : entries_of(*table_).entries) {
    if (asked_.contains(entry.key)) continue;
    asked_.insert(entry.key);
    all.emplace_back(entry.key, &entry.node);
  }
  return all;
}

std::optional<bool> TableReader::boolean(std::string_view key) {
  const Node* node = take(key);
  if (node == nullptr) return std::nullopt;
  if (const bool* flag = std::get_if<bool>(&node->value)) return *flag;
  complain_type(*node, key, "true or false");
  return std::nullopt;
}

std::optional<std::int64_t> TableReader::integer(std::string_view key,
                                                 Limits<std::int64_t> limits) {
  const Node* node = take(key);
  if (node == nullptr) return std::nullopt;
  const auto* value = std::get_if<std::int64_t>(&node->value);
  if (value == nullptr) {
    complain_type(*node, key, "an integer");
    return std::nullopt;
  }
  if (within(*value, limits)) return *value;
  const Limits<double> shown{static_cast<double>(limits.least), static_cast<double>(limits.most)};
  complain(key, "`" + std::string(key) + "` must be " + range_text(shown) + ", not " +
                    std::to_string(*value));
  return std::nullopt;
}

std::optional<double> TableReader::number(std::string_view key, Limits<double> limits) {
  const Node* node = take(key);
  if (node == nullptr) return std::nullopt;
  const auto value = as_number(*node);
  if (!value) {
    complain_type(*node, key, "a number");
    return std::nullopt;
  }
  if (within(*value, limits)) return value;
  complain(key, "`" + std::string(key) + "` must be " + range_text(limits) + ", not " +
                    number_text(*value));
  return std::nullopt;
}

std::optional<std::string> TableReader::text(std::string_view key) {
  const Node* node = take(key);
  if (node == nullptr) return std::nullopt;
  if (const auto* text = std::get_if<std::string>(&node->value)) return *text;
  complain_type(*node, key, "a text in quotes");
  return std::nullopt;
}

std::optional<std::string> TableReader::choice(std::string_view key,
                                               std::span<const std::string> choices,
                                               std::span<const std::string> not_yet) {
  const auto value = text(key);
  if (!value || std::ranges::find(choices, *value) != choices.end()) return value;
  const std::string found = std::string(key) + " = \"" + *value + "\"";
  if (std::ranges::find(not_yet, *value) != not_yet.end()) {
    complain(key, found + " is not supported yet; this version has: " + joined(choices));
  } else {
    complain(key, "`" + std::string(key) + "` cannot be \"" + *value + "\"" +
                      did_you_mean(*value, choices) + "; it is one of: " + joined(choices));
  }
  return std::nullopt;
}

std::optional<double> TableReader::seconds(std::string_view key, Limits<double> limits) {
  const auto value = text(key);
  if (!value) return std::nullopt;
  const auto found = parse_seconds(*value);
  if (!found) {
    complain(key, "`" + std::string(key) + "` must be a time with its unit (ms, s, min, h), such " +
                      "as \"30 s\", not \"" + *value + "\"");
    return std::nullopt;
  }
  if (within(*found, limits)) return found;
  complain(key, "`" + std::string(key) + "` must be " + range_text(limits) + " seconds");
  return std::nullopt;
}

std::optional<std::chrono::year_month_day> TableReader::date(std::string_view key) {
  const Node* node = take(key);
  if (node == nullptr) return std::nullopt;
  const auto* value = std::get_if<DateOrTime>(&node->value);
  if (value != nullptr && value->date && value->date->ok()) return value->date;
  complain_type(*node, key, "a date such as 2027-01-31, without quotes and without a time");
  return std::nullopt;
}

std::optional<std::vector<std::string>> TableReader::texts(std::string_view key) {
  const Node* node = take(key);
  if (node == nullptr) return std::nullopt;
  const auto* array = std::get_if<Array>(&node->value);
  if (array == nullptr) {
    complain_type(*node, key, "a list of texts");
    return std::nullopt;
  }
  std::vector<std::string> texts;
  for (const Node& item : array->items) {
    const auto* text = std::get_if<std::string>(&item.value);
    if (text == nullptr) {
      complain_type(item, key, "a list of texts");
      return std::nullopt;
    }
    texts.push_back(*text);
  }
  return texts;
}

std::optional<Limits<double>> TableReader::interval(std::string_view key, std::string_view wanted) {
  const Node* node = take(key);
  if (node == nullptr) return std::nullopt;
  const auto* array = std::get_if<Array>(&node->value);
  const bool pair = array != nullptr && array->items.size() == 2;
  const auto least = pair ? as_number(array->items[0]) : std::nullopt;
  const auto most = pair ? as_number(array->items[1]) : std::nullopt;
  if (least && most) return Limits<double>{*least, *most};
  complain(key, "`" + std::string(key) + "` must be " + std::string(wanted));
  return std::nullopt;
}

std::optional<TableReader> TableReader::table(std::string_view key) {
  const Node* node = take(key);
  if (node == nullptr) return std::nullopt;
  if (std::holds_alternative<Table>(node->value)) {
    return TableReader(*node, path_of(key), *complaints_);
  }
  complain_type(*node, key, "a table");
  return std::nullopt;
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
  const Node* node = take(key);
  if (node == nullptr) return {};
  const auto* array = std::get_if<Array>(&node->value);
  if (array == nullptr) {
    complain_type(*node, key, "a list of tables");
    return {};
  }
  std::vector<TableReader> readers;
  for (const Node& item : array->items) {
    if (std::holds_alternative<Table>(item.value)) {
      readers.emplace_back(item, path_of(key), *complaints_, true);
    } else {
      complain_type(item, key, "a list of tables");
    }
  }
  return readers;
}

std::optional<std::vector<std::vector<double>>> TableReader::number_rows(std::string_view key,
                                                                         std::size_t width,
                                                                         Limits<double> limits,
                                                                         std::string_view example) {
  const Node* node = take(key);
  if (node == nullptr) return std::nullopt;
  const auto wrong = [&](const Node& where, const std::string& what) {
    complaints_->add(where.place, "`" + std::string(key) + "` must be a list of lists of " +
                                      counted(width, "number") + ", such as " +
                                      std::string(example) + what);
    return std::nullopt;
  };
  const auto* array = std::get_if<Array>(&node->value);
  if (array == nullptr) return wrong(*node, "");
  std::vector<std::vector<double>> rows;
  for (const Node& item : array->items) {
    const auto* row = std::get_if<Array>(&item.value);
    if (row == nullptr || row->items.size() != width) return wrong(item, "");
    rows.emplace_back();
    for (const Node& cell : row->items) {
      const auto value = as_number(cell);
      if (!value) return wrong(cell, "");
      if (!within(*value, limits)) {
        return wrong(cell, "; each " + range_text(limits) + ", not " + number_text(*value));
      }
      rows.back().push_back(*value);
    }
  }
  return rows;
}

void TableReader::finish(std::span<const std::string> not_yet) {
  const std::vector<std::string> known(asked_.begin(), asked_.end());
  for (const Table::Entry& entry : entries_of(*table_).entries) {
    if (asked_.contains(entry.key)) continue;
    if (std::ranges::find(not_yet, entry.key) != not_yet.end()) {
      complaints_->add(entry.place, "`" + entry.key + "` in " + name() + " is not supported yet");
      continue;
    }
    std::string hint = did_you_mean(entry.key, known);
    if (hint.empty()) hint = "; known are: " + joined(known);
    complaints_->add(entry.place, name() + " has no key " + shown_key(entry.key) + hint);
  }
}

bool is_name(std::string_view name) {
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  return !name.empty() && name.size() <= kLongestName &&
         name.find_first_not_of(kLetters) == std::string_view::npos;
}

bool check_name(TableReader& reader, const std::string& name,
                const std::vector<std::string>& taken) {
  if (name.empty() && !reader.has("name")) {
    reader.complain("name", reader.name() + " needs a `name`");
    return false;
  }
  if (!is_name(name)) {
    reader.complain("name",
                    "a name consists of letters, digits, `_`, `-` and `.`, is not empty, and has "
                    "at most " +
                        std::to_string(kLongestName) + " of them");
    return false;
  }
  if (std::ranges::find(taken, name) != taken.end()) {
    reader.complain("name", "two " + reader.name() + " have the name \"" + name + "\"");
    return false;
  }
  return true;
}

bool names_a_file(const std::string& word) {
  return word.ends_with(".toml") || word.find('/') != std::string::npos;
}

void read_format(TableReader& root) {
  // The format of the files that this program reads; it increases when the meaning of old files
  // changes.
  constexpr std::int64_t kFormat = 1;
  constexpr auto kAny = std::numeric_limits<std::int64_t>::max();
  const auto format = root.integer("format", {-kAny - 1, kAny});
  if (!root.has("format")) {
    root.complain("format", "the file must begin with its format: format = 1");
  } else if (format && *format < kFormat) {
    root.complain("format", "this program reads format 1, not format " + std::to_string(*format));
  } else if (format && *format != kFormat) {
    root.complain("format", "format " + std::to_string(*format) +
                                " is newer than this program, which reads format 1");
  }
}

}  // namespace swarmsmith
