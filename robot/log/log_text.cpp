#include "robot/log/log_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "base/text/document.h"
#include "base/text/table_reader.h"
#include "base/text/toml_text.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kKind = "robot log";

/// Visits the columns of a row in their order, each with its name.
template <class Row, class Field>
void visit_columns(Row& row, Field& field) {
  field("cycle", row.cycle);
  field("time_s", row.sensed.time_s);
  field("clock_s", row.clock_s);
  field("late_ms", row.late_ms);
  field("act", row.act);
  field("state", row.state);
  field("left_mps", row.command.left_mps);
  field("right_mps", row.command.right_mps);
  field("leds", row.command.leds);
  for (std::size_t i = 0; i < row.sensed.proximity_m.size(); ++i)
    field("prox" + std::to_string(i), row.sensed.proximity_m[i]);
  field("r", row.sensed.ground.r);
  field("g", row.sensed.ground.g);
  field("b", row.sensed.ground.b);
  field("raw_r", row.ground_as_sent.r);
  field("raw_g", row.ground_as_sent.g);
  field("raw_b", row.ground_as_sent.b);
  field("neighbours", row.sensed.neighbours);
  field("light", row.sensed.light_lux);
  for (const Feed feed : kAllFeeds)
    field("age_" + std::string(name_of(feed)) + "_ms", row.age_ms[index_of(feed)]);
  for (const Feed feed : kAllFeeds)
    field("stamp_" + std::string(name_of(feed)) + "_ms", row.stamp_ms[index_of(feed)]);
  field("drawn", row.drawn);
  field("event", row.event);
}

const std::vector<std::string>& columns() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names;
    const auto name = [&names](std::string column, const auto&) {
      names.push_back(std::move(column));
    };
    const LogRow row;
    visit_columns(row, name);
    return names;
  }();
  return all;
}

std::string leds_text(const Leds& leds) {
  if (leds == Leds{}) return "";
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const Rgb& led : leds) {
    for (const std::uint8_t channel : {led.r, led.g, led.b}) {
      text += kDigits[channel >> 4U];
      text += kDigits[channel & 0xfU];
    }
  }
  return text;
}

bool read_leds(std::string_view text, Leds& leds) {
  leds = {};
  if (text.empty()) return true;
  if (text.size() != leds.size() * 6) return false;
  const auto channel = [&text](std::uint8_t& value) {
    const auto read = std::from_chars(text.data(), text.data() + 2, value, 16);
    const bool right = read.ec == std::errc() && read.ptr == text.data() + 2;
    text.remove_prefix(2);
    return right;
  };
  for (Rgb& led : leds) {
    if (!(channel(led.r) && channel(led.g) && channel(led.b))) return false;
  }
  return true;
}

/// Writes the columns of a row one after another.
class RowWriter {
 public:
  template <class Value>
  void operator()(const std::string& /*column*/, const Value& value) {
    if (!text_.empty()) text_ += ',';
    add(value);
  }
  std::string take() { return std::move(text_) + "\n"; }

 private:
  /// The shortest digits that read back to the same bits, including -0 and infinities.
  void add(double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    text_.append(buffer.data(), end);
  }
  void add(std::integral auto value) { text_ += std::to_string(value); }
  void add(const std::optional<double>& value) {
    if (value) add(*value);
  }
  void add(Act act) { text_ += name_of(act); }
  void add(const Leds& leds) { text_ += leds_text(leds); }
  void add(const std::string& text) { text_ += csv_field(text); }
  void add(const EightReadings& lux) {
    if (lux != EightReadings{}) add_numbers(lux);
  }
  void add(const std::vector<Neighbour>& neighbours) {
    std::vector<double> numbers;
    for (const Neighbour& one : neighbours)
      numbers.insert(numbers.end(), {one.distance_m, one.direction_x, one.direction_y});
    add_numbers(numbers);
  }
  /// In one field, separated by blanks.
  void add_numbers(std::span<const double> numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (i > 0) text_ += ' ';
      add(numbers[i]);
    }
  }

  std::string text_;
};

/// Reads the fields of a row one after another, and remembers the first error.
class RowReader {
 public:
  explicit RowReader(const std::vector<std::string>& cells) : cells_(&cells) {}

  template <class Value>
  void operator()(const std::string& column, Value& value) {
    const std::string& cell = (*cells_)[next_++];
    const std::string wanted = read(cell, value);
    if (!wanted.empty() && error_.empty())
      error_ = "column " + column + ": expected " + wanted + ", found `" + cell + "`";
  }
  const std::string& error() const { return error_; }

 private:
  /// Each function returns a description of the expected text, or nothing if the cell is valid.
  static std::string read(std::string_view cell, double& value) {
    const auto number = number_in(cell);
    value = number.value_or(0);
    return number ? "" : "a number";
  }
  static std::string read(std::string_view cell, std::optional<double>& value) {
    return cell.empty() ? "" : read(cell, value.emplace());
  }
  static std::string read(std::string_view cell, std::integral auto& value) {
    const auto end = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    const bool right = end.ec == std::errc() && end.ptr == cell.data() + cell.size();
    return right ? "" : "an integer in its range";
  }
  static std::string read(std::string_view cell, Act& act) {
    const auto known = named<Act>(cell);
    act = known.value_or(Act::Step);
    return known ? "" : "`step` or `hold`";
  }
  static std::string read(std::string_view cell, Leds& leds) {
    return read_leds(cell, leds) ? "" : "five colours of six digits";
  }
  static std::string read(std::string_view cell, std::string& text) {
    text = cell;
    return "";
  }
  static std::string read(std::string_view cell, EightReadings& lux) {
    std::vector<double> numbers;
    std::string wanted = read(cell, lux.size(), numbers);
    if (numbers.size() > lux.size()) return "eight numbers or none";
    std::ranges::copy(numbers, lux.begin());
    return wanted;
  }
  static std::string read(std::string_view cell, std::vector<Neighbour>& neighbours) {
    std::vector<double> numbers;
    std::string wanted = read(cell, 3, numbers);
    for (std::size_t i = 0; i < numbers.size(); i += 3)
      neighbours.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    return wanted;
  }
  static std::string read(std::string_view cell, std::size_t multiple,
                          std::vector<double>& numbers) {
    while (!cell.empty()) {
      const std::size_t blank = cell.find(' ');
      const auto value = number_in(cell.substr(0, blank));
      if (!value) break;
      numbers.push_back(*value);
      cell = blank == std::string_view::npos ? "" : cell.substr(blank + 1);
    }
    if (cell.empty() && numbers.size() % multiple == 0) return "";
    numbers.clear();
    return "numbers separated by blanks, as many as a multiple of " + std::to_string(multiple);
  }

  const std::vector<std::string>* cells_;
  std::size_t next_ = 0;
  std::string error_;
};

constexpr Limits<std::int64_t> kCounts = {0, std::numeric_limits<std::int64_t>::max()};
constexpr double kMost = std::numeric_limits<double>::max();
constexpr Limits<double> kPositive = {0, kMost};
constexpr Limits<double> kAny = {-kMost, kMost};

/// Visits the fields of a head in their order, each with its key. `maybe` is for optional fields;
/// its first argument tells whether the field is written.
template <class Head, class Field>
void visit_head(Head& head, Field& field) {
  field("run", head.run);
  field("robot", head.robot);
  field("robot_index", head.robot_index, Limits<std::int64_t>{0, 1'000'000});
  field("machine", head.machine);
  field("machine_digest", head.machine_digest);
  field("flavour", head.flavour);
  field.maybe(!head.own_flavour.empty(), "own_flavour", head.own_flavour);
  field.maybe(!head.own_robot.empty(), "own_robot", head.own_robot);
  field("turn_clock", head.turn_clock);
  field("seed", head.seed, kCounts);
  field("lock_step", head.lock_step);
  field("period_s", head.period_s, kPositive);
  field("seconds", head.seconds, kPositive);
  field("max_mps", head.max_mps, kPositive);
  field("program", head.program);
  field("host", head.host);
  field("scheduling", head.scheduling);
  field("start_clock_s", head.start_clock_s, kAny);
  field("start_unix_s", head.start_unix_s, kAny);
  field.maybe(head.clock_offset_s.has_value(), "clock_offset_s", head.clock_offset_s, kAny);
}

template <class End, class Field>
void visit_end(End& end, Field& field) {
  const bool driven = end.driven.value_or(false);
  field("state", end.state);
  field("verdict", end.verdict);
  field.maybe(true, "reasons", end.reasons);
  field("stepped", end.stepped, kCounts);
  field("held", end.held, kCounts);
  field("skipped", end.skipped, kCounts);
  field.maybe(end.driven.has_value(), "driven", end.driven);
  field.maybe(driven, "driver", end.driver);
  field.maybe(driven, "driver_off_s", end.driver_off_s, kPositive);
}

class HeadWriter {
 public:
  explicit HeadWriter(Section& section) : section_(&section) {}

  void operator()(const char* key, const auto& value, const auto&... /*limits*/) {
    section_->lines.push_back({key, toml_of(value)});
  }
  void maybe(bool is_written, const char* key, const auto& value, const auto&... /*limits*/) {
    if (is_written) (*this)(key, value);
  }

 private:
  static std::string toml_of(const std::string& text) { return quoted_text(text); }
  static std::string toml_of(bool flag) { return flag_text(flag); }
  static std::string toml_of(std::int64_t number) { return std::to_string(number); }
  static std::string toml_of(double number) { return number_text(number); }
  static std::string toml_of(RunVerdict verdict) { return quoted_text(name_of(verdict)); }
  template <class Value>
  static std::string toml_of(const std::optional<Value>& value) {
    return toml_of(*value);
  }
  static std::string toml_of(const std::vector<std::string>& texts) {
    return "[" + list_of(texts, quoted_text) + "]";
  }

  Section* section_;
};

class HeadReader {
 public:
  explicit HeadReader(TableReader& table) : table_(&table) {}

  /// A required key.
  void operator()(const char* key, auto& value, const auto&... limits) {
    if (!table_->has(key))
      table_->complain(key, table_->name() + " needs `" + std::string(key) + "`");
    maybe(true, key, value, limits...);
  }
  void maybe(bool /*is_written*/, const char* key, auto& value, const auto&... limits) {
    if (auto found = read(key, value, limits...)) value = std::move(*found);
  }

 private:
  auto read(const char* key, const std::string&) { return table_->text(key); }
  auto read(const char* key, const std::vector<std::string>&) { return table_->texts(key); }
  auto read(const char* key, bool) { return table_->boolean(key); }
  auto read(const char* key, const std::optional<bool>&) { return table_->boolean(key); }
  auto read(const char* key, std::int64_t, Limits<std::int64_t> limits) {
    return table_->integer(key, limits);
  }
  auto read(const char* key, const std::optional<double>&, Limits<double> limits) {
    return table_->number(key, limits);
  }
  std::optional<RunVerdict> read(const char* key, RunVerdict) {
    constexpr auto kNames = names_of(RunVerdict());
    const auto name = table_->choice(key, std::vector<std::string>(kNames.begin(), kNames.end()));
    return name ? named<RunVerdict>(*name) : std::nullopt;
  }

  TableReader* table_;
};

void read_head(TableReader& root, LogHead& head) {
  const std::vector<std::string> kinds = {std::string(kKind)};
  if (!root.choice("kind", kinds) && !root.has("kind"))
    root.complain("kind", "this is not a robot's log: `kind = \"robot log\"` is missing");
  HeadReader reader(root);
  visit_head(head, reader);
  if (auto topics = root.table("topics")) {
    for (const auto& [name, node] : topics->take_all()) {
      const auto* topic = std::get_if<std::string>(&node->value);
      if (topic == nullptr) {
        topics->complain(name, "`" + name + "` must be a text, the topic");
      } else {
        head.topics.emplace_back(name, *topic);
      }
    }
    topics->finish();
  }
  auto end = root.table("end");
  if (!end) return;
  HeadReader end_reader(*end);
  visit_end(head.end.emplace(), end_reader);
  end->finish();
}

}  // namespace

std::string log_columns() {
  return csv_line(columns());
}

std::string log_line(const LogRow& row) {
  RowWriter writer;
  visit_columns(row, writer);
  return writer.take();
}

std::string log_head_text(const LogHead& head) {
  std::vector<Section> sections = {
      {.header = "", .prefix = "", .lines = {{"format", "1"}, {"kind", quoted_text(kKind)}}}};
  HeadWriter writer(sections.back());
  visit_head(head, writer);
  if (!head.topics.empty()) {
    Section& topics =
        sections.emplace_back(Section{.header = "[topics]", .prefix = "", .lines = {}});
    for (const auto& [name, topic] : head.topics)
      topics.lines.push_back({name, quoted_text(topic)});
  }
  if (head.end) {
    HeadWriter end(sections.emplace_back(Section{.header = "[end]", .prefix = "", .lines = {}}));
    visit_end(*head.end, end);
  }
  return text_of(sections);
}

OrErrors<std::vector<LogRow>> parse_log_rows(std::string_view text, const std::string& file) {
  const auto wrong = [&file](std::size_t line, const std::string& message) {
    return tl::unexpected(
        std::vector<Error>{{ErrorKind::BadInput, message, file + ":" + std::to_string(line)}});
  };
  text = text.substr(0, text.rfind('\n') + 1);  // drops a row that was being written
  CsvReader reader(text);
  if (reader.at_end() || reader.next() != columns()) {
    return wrong(1,
                 "this is not the headline of a robot's log: expected `cycle,time_s,clock_s,...`");
  }
  std::vector<LogRow> rows;
  while (!reader.at_end()) {
    const std::size_t line = reader.line();
    const auto cells = reader.next();
    if (!cells) return wrong(line, "a quote is not closed");
    if (cells->size() != columns().size()) {
      return wrong(line, "a row has " + std::to_string(columns().size()) +
                             " fields, this one has " + std::to_string(cells->size()));
    }
    RowReader row_reader(*cells);
    visit_columns(rows.emplace_back(), row_reader);
    if (!row_reader.error().empty()) return wrong(line, row_reader.error());
  }
  return rows;
}

OrErrors<LogHead> parse_log_head(std::string_view text, const std::string& file) {
  const auto document = parse_document(text, file);
  if (!document) return tl::unexpected(std::vector<Error>{document.error()});
  Complaints complaints(file);
  TableReader root(*document, "", complaints);
  LogHead head;
  read_format(root);
  read_head(root, head);
  root.finish();
  if (!complaints.empty()) return tl::unexpected(complaints.take());
  return head;
}

}  // namespace swarmsmith
