#include "sim/files/profile_file.h"

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "base/assert.h"
#include "base/suggestion.h"
#include "embedded/kArgos3Profile.h"
#include "embedded/kPseudoRealityProfile.h"
#include "embedded/kRvrProfile.h"
#include "sim/engine/profile_fields.h"
#include "sim/files/color_text.h"
#include "sim/files/document.h"
#include "sim/files/file_text.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kFiles = {
    {{"rvr", kRvrProfile}, {"argos3", kArgos3Profile}, {"pseudo-reality", kPseudoRealityProfile}}};

/// Delays act in whole sub-steps of the engine.
constexpr double kSubSteps_per_s = 100;
/// Control periods are told to the microsecond, so that texts read back to the same bits.
constexpr double kMicroseconds_per_period = 100'000;

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
        table->complain(key, "there is no colour \"" + text + "\"; known are: " + known_colors());
      }
      colors.push_back(color.value_or(Rgb{}));
    }
  }
  void delays(std::string_view key, std::vector<ControlTiming::Delay>& delays) {
    TableReader* table = current();
    if (table == nullptr || !table->has(key)) return;
    delays.clear();
    for (TableReader& item : table->tables(key)) {
      for (const char* wanted : {"time", "probability"}) {
        if (!item.has(wanted))
          item.complain(wanted, "a delay needs a `" + std::string(wanted) + "`");
      }
      const double steps =
          kSubSteps_per_s * item.seconds("time", {0, kLongestDelay / kSubSteps_per_s}).value_or(0);
      if (std::abs(steps - std::round(steps)) > 1e-6) {
        item.complain("time", "`time` must be a multiple of 10 ms, the step of the simulator");
      }
      const auto probability = item.number("probability", {0, 1});
      delays.push_back({static_cast<int>(std::lround(steps)), probability.value_or(0)});
      item.finish();
    }
    if (is_distribution(delays)) return;
    double sum = 0;
    for (const ControlTiming::Delay& delay : delays)
      sum += delay.probability;
    table->complain(key, "the probabilities of `" + std::string(key) +
                             "` must sum to 1, these sum to " + number_text(sum));
  }
  void period(std::string_view key, double& least, double& most) {
    TableReader* table = current();
    const auto texts = table == nullptr ? std::nullopt : table->texts(key);
    if (!texts) return;
    const auto first = texts->size() == 2 ? factor_of((*texts)[0]) : std::nullopt;
    const auto second = texts->size() == 2 ? factor_of((*texts)[1]) : std::nullopt;
    if (!first || !second || *first > *second) {
      table->complain(key, "`" + std::string(key) +
                               "` must be the shortest and the longest period, from 10 ms to 1 s, "
                               "such as [\"75 ms\", \"100 ms\"]");
      return;
    }
    least = *first;
    most = *second;
  }
  void point(std::string_view key, Point& point, FieldLimits limits) {
    TableReader* table = current();
    const auto pair = table == nullptr ? std::nullopt : table->interval(key);
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

/// The visitor that writes them.
class FieldWriter {
 public:
  FieldWriter(std::vector<Section>& sections, std::string header)
      : sections_(&sections), header_(std::move(header)) {
    sections_->push_back({"[" + header_ + "]", header_ + ".", {}});
  }

  void device(std::string_view name) {
    const std::string path = header_ + "." + std::string(name);
    sections_->push_back({"[" + path + "]", path + ".", {}});
  }
  void number(std::string_view key, double value, FieldLimits) { add(key, number_text(value)); }
  void flag(std::string_view key, bool value) { add(key, flag_text(value)); }
  template <class Value>
  void choice(std::string_view key, Value value, const FieldChoices<Value>& choices) {
    add(key, quoted_text(word_of(value, choices)));
  }
  void colors(std::string_view key, const std::vector<Rgb>& colors) {
    add(key, "[" + list_of(colors, [](Rgb c) { return quoted_text(color_text(c)); }) + "]");
  }
  void delays(std::string_view key, const std::vector<ControlTiming::Delay>& delays) {
    add(key, "[" + list_of(delays, [](const ControlTiming::Delay& delay) {
               return "{ time = \"" + std::to_string(10 * delay.sub_steps) +
                      " ms\", probability = " + number_text(delay.probability) + " }";
             }) + "]");
  }
  void period(std::string_view key, double least, double most) {
    add(key, "[" + period_text(least) + ", " + period_text(most) + "]");
  }
  void point(std::string_view key, Point point, FieldLimits) {
    add(key, "[" + number_text(point.x) + ", " + number_text(point.y) + "]");
  }

  void add(std::string_view key, std::string value) {
    sections_->back().lines.push_back({std::string(key), std::move(value)});
  }

 private:
  static std::string period_text(double factor) {
    return "\"" + number_text(std::round(factor * kMicroseconds_per_period) / 1000) + " ms\"";
  }

  std::vector<Section>* sections_;
  std::string header_;
};

/// The fields of a table, over those of the profile that `base` names.
void read_fields(TableReader& table, Profile& profile) {
  const std::vector<std::string> names = profile_names();
  if (const auto base = table.choice("base", names)) {
    std::string name = std::move(profile.name);
    profile = built_in_profile(*base).value();
    profile.name = std::move(name);
  }
  FieldReader reader(table);
  visit_fields(profile, reader);
  reader.finish();
}

/// What nobody may call his own profile: a stored "rvr" must mean ours.
bool takes_a_name_of_ours(const Profile& profile) {
  const auto ours = built_in_profile(profile.name);
  return ours && *ours != profile;
}

ProfileOrErrors read_profile_file(const std::filesystem::path& file) {
  const auto text = read_file(file, "profile");
  if (!text) return tl::unexpected(std::vector<Error>{text.error()});
  auto profile = parse_profile(*text, file);
  if (profile && takes_a_name_of_ours(*profile)) {
    const std::string why = "a profile has its file's name, and `" + profile->name +
                            "` is built in with other values; give the file another name";
    return tl::unexpected(std::vector<Error>{{ErrorKind::BadInput, why, file.string()}});
  }
  return profile;
}

}  // namespace

std::vector<std::string> profile_names() {
  std::vector<std::string> names;
  for (const auto& [name, text] : kFiles)
    names.emplace_back(name);
  return names;
}

std::string_view built_in_profile_text(std::string_view name) {
  for (const auto& [known, text] : kFiles) {
    if (known == name) return text;
  }
  return {};
}

Expected<Profile> built_in_profile(std::string_view name) {
  const std::string_view text = built_in_profile_text(name);
  if (text.empty()) {
    const std::vector<std::string> names = profile_names();
    return unexpected(ErrorKind::NotFound, "there is no simulator profile `" + std::string(name) +
                                               "`" + did_you_mean(name, names) +
                                               "; built in are: " + joined(names) +
                                               "; a file of your own ends in .toml");
  }
  auto profile = parse_profile(text, std::string(name) + ".toml");
  SWARMSMITH_ASSERT(profile.has_value(), "the profiles that the program carries can be read");
  return std::move(*profile);
}

ProfileOrErrors parse_profile(std::string_view text, const std::filesystem::path& file) {
  const auto document = parse_document(text, file.string());
  if (!document) return tl::unexpected(std::vector<Error>{document.error()});
  Complaints complaints(file.string());
  TableReader root(*document, "", complaints);
  Profile profile{.name = file.stem().string()};
  read_format(root);
  read_fields(root, profile);
  root.finish();
  if (!complaints.empty()) return tl::unexpected(complaints.take());
  return profile;
}

ProfileOrErrors find_profile(const std::string& word, const std::filesystem::path& folder) {
  if (names_a_file(word)) return read_profile_file(folder / word);
  auto profile = built_in_profile(word);
  if (!profile) return tl::unexpected(std::vector<Error>{profile.error()});
  return std::move(*profile);
}

Profile read_profile_table(TableReader& table) {
  Profile profile;
  if (!table.has("name")) table.complain("name", table.name() + " needs a `name`");
  profile.name = table.text("name").value_or("");
  read_fields(table, profile);
  table.finish();
  return profile;
}

std::vector<Section> profile_sections(const Profile& profile, const std::string& header) {
  std::vector<Section> sections;
  FieldWriter writer(sections, header);
  writer.add("name", quoted_text(profile.name));
  visit_fields(profile, writer);
  return sections;
}

}  // namespace swarmsmith
