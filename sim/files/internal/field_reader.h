#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "sim/engine/profile_fields.h"
#include "sim/files/color_text.h"
#include "sim/files/internal/read_profile.h"
#include "sim/files/internal/read_solids.h"
#include "sim/robot/robot_fields.h"

namespace swarmsmith {

/// Delays and beats are whole sub-steps of the engine.
inline constexpr double kSubSteps_per_s = 100;

/// The visitor that reads the fields of a profile or a robot from its table and subtables. A field
/// that is missing in the file keeps its value.
class FieldReader {
 public:
  /// `ranges` receives the numbers that are given as ranges; null if ranges are not allowed.
  explicit FieldReader(TableReader& root, std::vector<FieldRange>* ranges = nullptr)
      : root_(&root), ranges_(ranges) {}

  void device(std::string_view name) {
    finish();
    in_device_ = true;
    device_name_ = std::string(name) + ".";
    if (auto table = root_->table(name)) device_ = std::make_unique<TableReader>(*table);
  }
  /// Must also be called after the visit, since no next device finishes the last one.
  void finish() {
    if (device_) device_->finish();
    device_.reset();
  }

  void number(std::string_view key, double& value, FieldLimits limits) {
    TableReader* table = current();
    if (table == nullptr) return;
    if (ranges_ != nullptr && read_range(*table, key, value, limits)) return;
    value = table->number(key, {limits.least, limits.most}).value_or(value);
  }
  void flag(std::string_view key, bool& value) {
    if (TableReader* table = current()) value = table->boolean(key).value_or(value);
  }
  template <class Value>
  void choice(std::string_view key, Value& value, const FieldChoices<Value>& choices) {
    TableReader* table = current();
    if (table == nullptr) return;
    std::vector<std::string> words;
    for (const auto& [word, meaning] : choices)
      words.emplace_back(word);
    const auto found = table->choice(key, words);
    for (const auto& [word, meaning] : choices) {
      if (found == word) value = meaning;
    }
  }
  void colors(std::string_view key, std::vector<Rgb>& colors) {
    TableReader* table = current();
    const auto texts = table == nullptr ? std::nullopt : table->texts(key);
    if (!texts) return;
    if (texts->empty()) table->complain(key, "`" + std::string(key) + "` must name a colour");
    colors.clear();
    for (const std::string& text : *texts) {
      const auto color = parse_color(text);
      if (!color) {
        table->complain(key, no_such_color(text));
      }
      colors.push_back(color.value_or(Rgb{}));
    }
  }
  void delays(std::string_view key, std::vector<ControlTiming::Delay>& delays) {
    TableReader* table = current();
    if (table == nullptr || !table->has(key)) return;
    delays.clear();
    const std::size_t before = table->complaints();
    for (TableReader& item : table->tables(key)) {
      for (const char* wanted : {"time", "probability"}) {
        if (!item.has(wanted))
          item.complain(wanted, "a delay needs a `" + std::string(wanted) + "`");
      }
      const int steps = sub_steps(item, "time").value_or(0);
      const auto probability = item.number("probability", {0, 1});
      delays.push_back({steps, probability.value_or(0)});
      item.finish();
    }
    // If a probability could not be read, a complaint about the sum would only confuse.
    if (table->complaints() > before || is_distribution(delays)) return;
    double sum = 0;
    for (const ControlTiming::Delay& delay : delays)
      sum += delay.probability;
    table->complain(key, "the probabilities of `" + std::string(key) +
                             "` must sum to 1, these sum to " + number_text(sum));
  }
  void beat(std::string_view key, int& value) {
    TableReader* table = current();
    if (table != nullptr) value = sub_steps(*table, key).value_or(value);
  }
  template <class Visit>
  void later(bool /*is_ideal*/, const Visit& visit) {
    visit();
  }
  template <class Visit>
  void only(const FieldUse& /*use*/, const Visit& visit) {
    visit();
  }
  void period(std::string_view key, double& least, double& most) {
    TableReader* table = current();
    const auto texts = table == nullptr ? std::nullopt : table->texts(key);
    if (!texts) return;
    const auto first = texts->size() == 2 ? factor_of((*texts)[0]) : std::nullopt;
    const auto second = texts->size() == 2 ? factor_of((*texts)[1]) : std::nullopt;
    if (!first || !second || *first > *second) {
      table->complain(key, "`" + std::string(key) +
                               "` must be the shortest and the longest period, from 1 ms to 1 s, "
                               "such as [\"75 ms\", \"100 ms\"]");
      return;
    }
    least = *first;
    most = *second;
  }
  void point(std::string_view key, Point& point, FieldLimits limits) {
    TableReader* table = current();
    if (table == nullptr) return;
    const auto pair = table->interval(key, "a place of two numbers in metres, such as [0.1, 0]");
    if (!pair) return;
    if (!limits.contain(pair->least) || !limits.contain(pair->most)) {
      table->complain(key, "both numbers of `" + std::string(key) + "` must be from " +
                               number_text(limits.least) + " to " + number_text(limits.most));
      return;
    }
    point = {pair->least, pair->most};
  }

  void outline(Outline& outline) {
    TableReader* table = current();
    if (table == nullptr) return;
    if (auto read = read_changed_outline(*table, kBodySize, outline)) outline = std::move(*read);
  }
  void angles(std::string_view key, std::vector<double>& angles) {
    read_list(key, kMostRingSensors, "sensors", "angles in degrees, such as [0, 45, -45]",
              {-360, 360}, angles);
  }
  void numbers(std::string_view key, std::array<double, 3>& numbers, FieldLimits limits) {
    std::vector<double> list(numbers.begin(), numbers.end());
    TableReader* table = current();
    if (table == nullptr || !table->has(key)) return;
    read_list(key, numbers.size(), "numbers", "three numbers, such as [1, -20, 0]", limits, list);
    if (list.size() != numbers.size()) {
      table->complain(key, "`" + std::string(key) + "` must be three numbers");
      return;
    }
    std::ranges::copy(list, numbers.begin());
  }
  void points(std::string_view key, std::vector<Point>& points) {
    TableReader* table = current();
    if (table == nullptr || !table->has(key)) return;
    const auto rows = table->number_rows(key, 2, {-5, 5}, "[[0.05, 0]]");
    if (!rows) return;
    if (rows->empty() || rows->size() > kMostGroundPoints) {
      table->complain(key, "`" + std::string(key) + "` must be 1 to " +
                               std::to_string(kMostGroundPoints) + " places, these are " +
                               std::to_string(rows->size()));
      return;
    }
    points.clear();
    for (const std::vector<double>& row : *rows)
      points.push_back({row[0], row[1]});
  }
  void count(std::string_view key, int& value, int least, int most) {
    TableReader* table = current();
    if (table == nullptr) return;
    if (const auto read = table->integer(key, {least, most})) value = static_cast<int>(*read);
  }

 private:
  void read_list(std::string_view key, std::size_t most, const std::string& what,
                 const std::string& wanted, FieldLimits limits, std::vector<double>& list) {
    TableReader* table = current();
    const Node* node = table == nullptr ? nullptr : table->take(key);
    if (node == nullptr) return;
    const auto* array = std::get_if<Array>(&node->value);
    std::vector<double> read;
    bool right = array != nullptr;
    for (const Node& item : right ? array->items : std::vector<Node>{}) {
      const auto* whole = std::get_if<std::int64_t>(&item.value);
      const auto* real = std::get_if<double>(&item.value);
      read.push_back(whole != nullptr ? static_cast<double>(*whole) : real != nullptr ? *real : 0);
      right = right && (whole != nullptr || real != nullptr) && limits.contain(read.back());
    }
    if (!right) {
      table->complain(key, "`" + std::string(key) + "` must be a list of " + wanted +
                               ", each from " + number_text(limits.least) + " to " +
                               number_text(limits.most));
    } else if (read.size() > most) {
      table->complain(key, "`" + std::string(key) + "` has " + std::to_string(read.size()) + " " +
                               what + "; at most " + std::to_string(most) + " are allowed");
    } else {
      list = std::move(read);
    }
  }
  /// Reads a range, if the value is one: [0, 0.1] is drawn for each robot and run, { run = [0, 0.1]
  /// } once per run.
  bool read_range(TableReader& table, std::string_view key, double& value, FieldLimits limits) {
    const std::string field = device_name_ + std::string(key);
    const Node* node = table.take(key);
    if (node == nullptr) return false;
    std::erase_if(*ranges_, [&](const FieldRange& range) { return range.field == field; });
    const bool of_run = std::holds_alternative<Table>(node->value);
    if (!of_run && !std::holds_alternative<Array>(node->value)) return false;
    constexpr const char* kWanted =
        "a number, a range such as [0, 0.1] that is drawn for each "
        "robot and run, or { run = [0, 0.1] }, drawn for the run";
    std::optional<Limits<double>> range;
    if (of_run) {
      auto inner = table.table(key);
      if (!inner->has("run")) inner->complain("run", "`" + field + "` must be " + kWanted);
      range = inner->interval("run", kWanted);
      inner->finish();
    } else {
      range = table.interval(key, kWanted);
    }
    if (!range) return true;
    if (range->least > range->most) {
      table.complain(key, "the ends of the range `" + field +
                              "` are in the wrong order: " + number_text(range->least) +
                              " is more than " + number_text(range->most));
    } else if (!limits.contain(range->least) || !limits.contain(range->most)) {
      table.complain(key, "the range `" + field + "` must be within " + number_text(limits.least) +
                              " and " + number_text(limits.most));
    } else {
      value = range->least;
      ranges_->push_back({field, range->least, range->most, of_run});
    }
    return true;
  }
  /// Null for a device that is missing in the file.
  TableReader* current() {
    if (!in_device_) return root_;
    return device_.get();
  }
  static std::optional<int> sub_steps(TableReader& table, std::string_view key) {
    const auto time_s = table.seconds(key, {0, kLongestDelay / kSubSteps_per_s});
    if (!time_s) return std::nullopt;
    const double steps = kSubSteps_per_s * *time_s;
    if (std::abs(steps - std::round(steps)) > 1e-6) {
      table.complain(
          key, "`" + std::string(key) + "` must be a multiple of 10 ms, the step of the simulator");
    }
    return static_cast<int>(std::lround(steps));
  }
  static std::optional<double> factor_of(const std::string& text) {
    const auto seconds = parse_seconds(text);
    if (!seconds) return std::nullopt;
    const double factor = std::round(*seconds * 1e6) / kMicroseconds_per_period;
    if (!kPeriodFactor.contain(factor)) return std::nullopt;
    return factor;
  }

  TableReader* root_;
  std::vector<FieldRange>* ranges_;
  std::string device_name_;
  std::unique_ptr<TableReader> device_;
  bool in_device_ = false;
};

}  // namespace swarmsmith
