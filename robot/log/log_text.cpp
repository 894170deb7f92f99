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

/// The columns of a feed's ages and delays.
std::string feed_column(std::string_view what, Feed feed) {
  return std::string(what) + "_" + std::string(name_of(feed)) + "_ms";
}

const std::vector<std::string>& columns() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names = {"cycle", "time_s",   "clock_s",   "late_ms", "act",
                                      "state", "left_mps", "right_mps", "leds"};
    for (int i = 0; i < kProximitySensors; ++i)
      names.push_back("prox" + std::to_string(i));
    names.insert(names.end(), {"r", "g", "b", "raw_r", "raw_g", "raw_b", "neighbours", "light"});
    for (const Feed feed : kAllFeeds)
      names.push_back(feed_column("age", feed));
    for (const Feed feed : kAllFeeds)
      names.push_back(feed_column("stamp", feed));
    names.insert(names.end(), {"drawn", "event"});
    return names;
  }();
  return all;
}

/// Fields of a line, one after the other.
class Line {
 public:
  Line& add(std::string_view field) {
    if (!text_.empty()) text_ += ',';
    text_ += field;
    return *this;
  }
  Line& add(double value) {
    comma();
    number(value);
    return *this;
  }
  Line& add(std::optional<double> value) { return value ? add(*value) : empty(); }
  template <std::integral Integer>
  Line& add(Integer value) {
    return add(std::string_view(std::to_string(value)));
  }
  /// Several numbers in one field, with blanks.
  template <class Numbers>
  Line& add_numbers(const Numbers& numbers) {
    comma();
    bool first = true;
    for (const double value : numbers) {
      if (!first) text_ += ' ';
      first = false;
      number(value);
    }
    return *this;
  }
  std::string take() { return std::move(text_) + "\n"; }

 private:
  void comma() { text_ += ','; }
  Line& empty() {
    comma();
    return *this;
  }
  /// The shortest digits that read back to the same bits, -0 and infinities as well.
  void number(double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    text_.append(buffer.data(), end);
  }

  std::string text_;
};

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

/// Takes the fields of a row in order, and remembers the first one that is wrong.
class Fields {
 public:
  explicit Fields(const std::vector<std::string>& cells) : cells_(&cells) {}

  std::string_view text() { return (*cells_)[next_++]; }
  void number(double& value) {
    const std::string_view field = text();
    if (const auto read = number_in(field)) {
      value = *read;
    } else {
      wrong("a number", field);
    }
  }
  void number(std::optional<double>& value) {
    if ((*cells_)[next_].empty()) {
      ++next_;
      return;
    }
    number(value.emplace());
  }
  template <std::integral Integer>
  void integer(Integer& value) {
    const std::string_view field = text();
    const auto read = std::from_chars(field.data(), field.data() + field.size(), value);
    if (read.ec != std::errc() || read.ptr != field.data() + field.size())
      wrong("an integer in its range", field);
  }
  std::vector<double> numbers(std::size_t multiple) {
    const std::string_view field = text();
    std::vector<double> values;
    std::string_view rest = field;
    while (!rest.empty()) {
      const std::size_t blank = rest.find(' ');
      const auto value = number_in(rest.substr(0, blank));
      if (!value) break;
      values.push_back(*value);
      rest = blank == std::string_view::npos ? "" : rest.substr(blank + 1);
    }
    if (!rest.empty() || values.size() % multiple != 0) {
      wrong("numbers with blanks between, a multiple of " + std::to_string(multiple), field);
      values.clear();
    }
    return values;
  }
  void wrong(const std::string& wanted, std::string_view found) {
    if (!error_.empty()) return;
    error_ = "column " + columns()[next_ - 1] + ": expected " + wanted + ", found `" +
             std::string(found) + "`";
  }
  const std::string& error() const { return error_; }

 private:
  const std::vector<std::string>* cells_;
  std::size_t next_ = 0;
  std::string error_;
};

constexpr std::size_t kNeighbourNumbers = 3;

Expected<LogRow> row_of(const std::vector<std::string>& cells) {
  Fields fields(cells);
  LogRow row;
  fields.integer(row.cycle);
  fields.number(row.sensed.time_s);
  fields.number(row.clock_s);
  fields.number(row.late_ms);
  const std::string_view act = fields.text();
  if (const auto known = act_from(act)) {
    row.act = *known;
  } else {
    fields.wrong("`step` or `hold`", act);
  }
  fields.integer(row.state);
  fields.number(row.command.left_mps);
  fields.number(row.command.right_mps);
  const std::string_view leds = fields.text();
  if (!read_leds(leds, row.command.leds)) fields.wrong("five colours of six digits", leds);
  for (double& distance : row.sensed.proximity_m)
    fields.number(distance);
  fields.integer(row.sensed.ground.r);
  fields.integer(row.sensed.ground.g);
  fields.integer(row.sensed.ground.b);
  fields.number(row.ground_as_sent.r);
  fields.number(row.ground_as_sent.g);
  fields.number(row.ground_as_sent.b);
  const std::vector<double> neighbours = fields.numbers(kNeighbourNumbers);
  for (std::size_t i = 0; i < neighbours.size(); i += kNeighbourNumbers)
    row.sensed.neighbours.push_back({neighbours[i], neighbours[i + 1], neighbours[i + 2]});
  const std::vector<double> light = fields.numbers(kProximitySensors);
  if (light.size() > kProximitySensors) fields.wrong("eight numbers or none", "more");
  if (!light.empty()) std::copy_n(light.begin(), kProximitySensors, row.sensed.light_lux.begin());
  for (std::optional<double>& age : row.age_ms)
    fields.number(age);
  for (std::optional<double>& stamp : row.stamp_ms)
    fields.number(stamp);
  fields.integer(row.drawn);
  row.event = fields.text();
  if (!fields.error().empty()) return bad_input(fields.error());
  return row;
}

std::string texts_of(const std::vector<std::string>& texts) {
  return "[" + list_of(texts, quoted_text) + "]";
}

constexpr Limits<std::int64_t> kCounts = {0, std::numeric_limits<std::int64_t>::max()};
constexpr double kMost = std::numeric_limits<double>::max();
constexpr Limits<double> kPositive = {0, kMost};
constexpr Limits<double> kAny = {-kMost, kMost};

/// Takes a key that must be there.
template <class T, class U>
void need(TableReader& table, std::string_view key, const std::optional<U>& read, T& value) {
  if (read) {
    value = *read;
  } else if (!table.has(key)) {
    table.complain(key, table.name() + " needs `" + std::string(key) + "`");
  }
}

void read_end(TableReader& root, LogHead& head) {
  auto table = root.table("end");
  if (!table) return;
  RunEnd& end = head.end.emplace();
  need(*table, "state", table->text("state"), end.state);
  const std::vector<std::string> verdicts = {"VALID", "DEGRADED", "INVALID"};
  if (const auto verdict = table->choice("verdict", verdicts)) {
    end.verdict = *run_verdict_from(*verdict);
  } else if (!table->has("verdict")) {
    table->complain("verdict", "[end] needs a `verdict`");
  }
  if (auto reasons = table->texts("reasons")) end.reasons = std::move(*reasons);
  need(*table, "stepped", table->integer("stepped", kCounts), end.stepped);
  need(*table, "held", table->integer("held", kCounts), end.held);
  need(*table, "skipped", table->integer("skipped", kCounts), end.skipped);
  end.driven = table->boolean("driven");
  if (const auto driver = table->choice("driver", verdicts))
    end.driver = *run_verdict_from(*driver);
  if (const auto off_s = table->number("driver_off_s", {0, kMost})) end.driver_off_s = *off_s;
  table->finish();
}

void read_head(TableReader& root, LogHead& head) {
  const std::vector<std::string> kinds = {std::string(kKind)};
  if (!root.choice("kind", kinds) && !root.has("kind"))
    root.complain("kind", "this is no robot's log: `kind = \"robot log\"` is missing");
  need(root, "run", root.text("run"), head.run);
  need(root, "robot", root.text("robot"), head.robot);
  need(root, "robot_index", root.integer("robot_index", {0, 1'000'000}), head.robot_index);
  need(root, "machine", root.text("machine"), head.machine);
  need(root, "machine_digest", root.text("machine_digest"), head.machine_digest);
  need(root, "flavour", root.text("flavour"), head.flavour);
  need(root, "turn_clock", root.text("turn_clock"), head.turn_clock);
  need(root, "seed", root.integer("seed", kCounts), head.seed);
  need(root, "lock_step", root.boolean("lock_step"), head.lock_step);
  need(root, "period_s", root.number("period_s", kPositive), head.period_s);
  need(root, "seconds", root.number("seconds", kPositive), head.seconds);
  need(root, "max_mps", root.number("max_mps", kPositive), head.max_mps);
  need(root, "program", root.text("program"), head.program);
  need(root, "host", root.text("host"), head.host);
  need(root, "scheduling", root.text("scheduling"), head.scheduling);
  need(root, "start_clock_s", root.number("start_clock_s", kAny), head.start_clock_s);
  need(root, "start_unix_s", root.number("start_unix_s", kAny), head.start_unix_s);
  head.clock_offset_s = root.number("clock_offset_s", kAny);
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
  read_end(root, head);
}

}  // namespace

std::string log_columns() {
  return csv_line(columns());
}

std::string log_line(const LogRow& row) {
  Line line;
  line.add(row.cycle).add(row.sensed.time_s).add(row.clock_s).add(row.late_ms);
  line.add(name_of(row.act)).add(row.state);
  line.add(row.command.left_mps).add(row.command.right_mps).add(leds_text(row.command.leds));
  for (const double distance : row.sensed.proximity_m)
    line.add(distance);
  const Rgb& ground = row.sensed.ground;
  line.add(int{ground.r}).add(int{ground.g}).add(int{ground.b});
  line.add(row.ground_as_sent.r).add(row.ground_as_sent.g).add(row.ground_as_sent.b);
  std::vector<double> neighbours;
  for (const Neighbour& neighbour : row.sensed.neighbours) {
    neighbours.insert(neighbours.end(),
                      {neighbour.distance_m, neighbour.direction_x, neighbour.direction_y});
  }
  line.add_numbers(neighbours);
  const bool dark = row.sensed.light_lux == LightReadings{};
  line.add_numbers(dark ? std::span<const double>{}
                        : std::span<const double>(row.sensed.light_lux));
  for (const std::optional<double>& age : row.age_ms)
    line.add(age);
  for (const std::optional<double>& stamp : row.stamp_ms)
    line.add(stamp);
  line.add(row.drawn).add(csv_field(row.event));
  return line.take();
}

std::string log_head_text(const LogHead& head) {
  Section top{.header = "", .prefix = "", .lines = {}};
  const auto add = [](Section& section, const char* key, std::string value) {
    section.lines.push_back({key, std::move(value)});
  };
  add(top, "format", "1");
  add(top, "kind", quoted_text(kKind));
  add(top, "run", quoted_text(head.run));
  add(top, "robot", quoted_text(head.robot));
  add(top, "robot_index", std::to_string(head.robot_index));
  add(top, "machine", quoted_text(head.machine));
  add(top, "machine_digest", quoted_text(head.machine_digest));
  add(top, "flavour", quoted_text(head.flavour));
  add(top, "turn_clock", quoted_text(head.turn_clock));
  add(top, "seed", std::to_string(head.seed));
  add(top, "lock_step", flag_text(head.lock_step));
  add(top, "period_s", number_text(head.period_s));
  add(top, "seconds", number_text(head.seconds));
  add(top, "max_mps", number_text(head.max_mps));
  add(top, "program", quoted_text(head.program));
  add(top, "host", quoted_text(head.host));
  add(top, "scheduling", quoted_text(head.scheduling));
  add(top, "start_clock_s", number_text(head.start_clock_s));
  add(top, "start_unix_s", number_text(head.start_unix_s));
  if (head.clock_offset_s) add(top, "clock_offset_s", number_text(*head.clock_offset_s));
  std::vector<Section> sections = {std::move(top)};
  if (!head.topics.empty()) {
    Section topics{.header = "[topics]", .prefix = "", .lines = {}};
    for (const auto& [name, topic] : head.topics)
      add(topics, name.c_str(), quoted_text(topic));
    sections.push_back(std::move(topics));
  }
  if (head.end) {
    Section end{.header = "[end]", .prefix = "", .lines = {}};
    add(end, "state", quoted_text(head.end->state));
    add(end, "verdict", quoted_text(name_of(head.end->verdict)));
    add(end, "reasons", texts_of(head.end->reasons));
    add(end, "stepped", std::to_string(head.end->stepped));
    add(end, "held", std::to_string(head.end->held));
    add(end, "skipped", std::to_string(head.end->skipped));
    if (head.end->driven) add(end, "driven", *head.end->driven ? "true" : "false");
    if (head.end->driven.value_or(false)) {
      add(end, "driver", quoted_text(name_of(head.end->driver)));
      add(end, "driver_off_s", number_text(head.end->driver_off_s));
    }
    sections.push_back(std::move(end));
  }
  return text_of(sections);
}

OrErrors<std::vector<LogRow>> parse_log_rows(std::string_view text, const std::string& file) {
  const auto wrong = [&file](std::size_t line, const std::string& message) {
    return tl::unexpected(
        std::vector<Error>{{ErrorKind::BadInput, message, file + ":" + std::to_string(line)}});
  };
  text = text.substr(0, text.rfind('\n') + 1);  // nothing of a row that was being written
  CsvReader reader(text);
  if (reader.at_end() || reader.next() != columns()) {
    return wrong(1,
                 "this is not the headline of a robot's log: expected `cycle,time_s,clock_s,...`");
  }
  std::vector<LogRow> rows;
  while (!reader.at_end()) {
    const std::size_t line = reader.line();
    const auto cells = reader.next();
    if (!cells) return wrong(line, "a quote is opened and never closed");
    if (cells->size() != columns().size()) {
      return wrong(line, "a row has " + std::to_string(columns().size()) +
                             " fields, this one has " + std::to_string(cells->size()));
    }
    auto row = row_of(*cells);
    if (!row) return wrong(line, row.error().message);
    rows.push_back(std::move(*row));
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
