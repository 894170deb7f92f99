#include "sim/files/internal/read_profile.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/text/toml_text.h"
#include "sim/engine/profile_fields.h"
#include "sim/files/color_text.h"

namespace swarmsmith {
namespace {

/// Delays and beats are whole sub-steps of the engine.
constexpr double kSubSteps_per_s = 100;
/// The visitor that takes a profile's fields out of its table and the tables in it. A field that is
/// not there keeps its value.
class FieldReader {
 public:
  explicit FieldReader(TableReader& root) : root_(&root) {}

  void device(std::string_view name) {
    finish();
    in_device_ = true;
    if (auto table = root_->table(name)) device_ = std::make_unique<TableReader>(*table);
  }
  /// To be called after the visit, too: the last device has no next one.
  void finish() {
    if (device_) device_->finish();
    device_.reset();
  }

  void number(std::string_view key, double& value, FieldLimits limits) {
    TableReader* table = current();
    if (table != nullptr) value = table->number(key, {limits.least, limits.most}).value_or(value);
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
    if (texts->empty()) table->complain(key, "`" + std::string(key) + "` names no colour");
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
    // A sum over probabilities that could not be read would only confuse.
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

 private:
  /// Null for a device that the file leaves out.
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
  std::unique_ptr<TableReader> device_;
  bool in_device_ = false;
};

}  // namespace

void read_profile_fields(TableReader& table, Profile& profile) {
  FieldReader reader(table);
  visit_profile_fields(profile, reader);
  reader.finish();
}

}  // namespace swarmsmith
