#include "sim/files/machine_file.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/plain_text.h"
#include "base/text/document.h"
#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "sim/control/controller.h"
#include "sim/control/flavour_file.h"
#include "sim/control/flavour_text.h"
#include "sim/control/foreign_text.h"
#include "sim/files/internal/file_kind.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kHeadSign = "#:";
constexpr std::string_view kGenomeStart = "genomestart";
constexpr std::string_view kGenomeEnd = "genomeend";

/// Removes blanks, and a colon or comma between name and machine.
std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r:,";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

TurnClock read_turn_clock(TableReader& root) {
  static const std::vector<std::string> kNames = {std::string(name_of(TurnClock::Cycles)),
                                                  std::string(name_of(TurnClock::Seconds))};
  return root.choice("turn_clock", kNames) == kNames.back() ? TurnClock::Seconds
                                                            : TurnClock::Cycles;
}

/// Whether the key gives the name of a built-in value, instead of a table with its fields.
bool is_name_there(TableReader& root, std::string_view key) {
  const Node* node = root.take(key);
  return node != nullptr && std::holds_alternative<std::string>(node->value);
}

std::optional<Profile> read_profile(TableReader& root) {
  if (!root.has("profile")) return std::nullopt;
  if (is_name_there(root, "profile")) {
    auto profile = built_in_profile(root.text("profile").value_or(""));
    if (profile) return std::move(*profile);
    root.complain("profile", profile.error().message);
    return std::nullopt;
  }
  auto table = root.table("profile");
  if (!table) return std::nullopt;
  return read_profile_table(*table);
}

std::optional<MissionEntry> read_mission(TableReader& root) {
  if (!root.has("mission")) return std::nullopt;
  if (is_name_there(root, "mission")) {
    auto mission = built_in_mission(root.text("mission").value_or(""));
    if (mission) return MissionEntry{std::move(*mission)};
    root.complain("mission", mission.error().message);
    return std::nullopt;
  }
  auto missions = read_missions(root, {});
  if (missions.size() == 1) return std::move(missions.front());
  root.complain("mission", "a machine has one mission");
  return std::nullopt;
}

void read_flavour(TableReader& root, MachineHead& head) {
  if (!root.has("flavour")) return;
  if (is_name_there(root, "flavour")) {
    head.flavour = root.text("flavour").value_or("");
    if (const auto known = find_flavour(head.flavour); !known)
      root.complain("flavour", known.error().message +
                                   "; for one of your own, leave this line out and name its file "
                                   "with --flavour");
    return;
  }
  auto table = root.table("flavour");
  if (!table) return;
  const std::size_t before = root.complaints();
  Flavour flavour = read_flavour_table(*table);
  head.flavour = flavour.name;
  if (root.complaints() == before) head.own_flavour = kept_flavour(std::move(flavour));
}

/// `toml` has the lines of the head at their positions in the file.
MachineHead read_head(std::string_view toml, const std::string& file, std::vector<Error>& errors) {
  MachineHead head;
  const auto document = parse_document(toml, file);
  if (!document) {
    errors.push_back(document.error());
    return head;
  }
  Complaints complaints(file);
  TableReader root(*document, "", complaints);
  read_format(root);
  read_flavour(root, head);
  if (root.has("turn_clock")) head.turn_clock = read_turn_clock(root);
  head.profile = read_profile(root);
  head.mission = read_mission(root);
  head.seeds = root.text("seeds").value_or("");
  head.method = root.text("method").value_or("");
  head.design = root.text("design").value_or("");
  head.candidate = root.text("candidate").value_or("");
  head.campaign = root.text("campaign").value_or("");
  root.finish();
  for (Error& error : complaints.take())
    errors.push_back(std::move(error));
  return head;
}

/// Reads a file line by line.
class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  void take(std::string_view line) {
    ++number_;
    const std::string_view text = trimmed(line);
    const bool is_head = line.starts_with(kHeadSign);
    // Blank outside the head, so that errors in the head have the lines and columns of the file.
    toml_ += is_head ? "  " + std::string(line.substr(kHeadSign.size())) : "";
    toml_ += '\n';
    has_head_ = has_head_ || is_head;
    if (is_head || text.empty() || text.front() == '#' || is_comment(text)) return;
    if (in_genome_) {
      machines_.back().text += " " + std::string(text);
      in_genome_ = text.find(kGenomeEnd) == std::string_view::npos;
      return;
    }
    const std::size_t at = find_controller(text);
    if (at != std::string_view::npos) {
      begin(text, at);
    } else if (text.starts_with("--") && !machines_.empty() && !has_head_) {
      machines_.back().text += " " + std::string(text);
    } else {
      complain("control software begins with one of " + first_switches());
    }
  }

  tl::expected<std::vector<FiledMachine>, std::vector<Error>> finish() {
    if (has_head_) read_head(toml_, file_, errors_);
    if (machines_.empty() && errors_.empty()) {
      errors_.push_back({ErrorKind::BadInput, "the file contains no machine", file_});
    } else if (has_head_ && errors_.empty()) {
      errors_.push_back(
          {ErrorKind::BadInput, "no machine follows the lines `#:` at the end of the file", file_});
    }
    if (!errors_.empty()) return tl::unexpected(counted());
    return std::move(machines_);
  }

 private:
  static bool is_comment(std::string_view text) {
    return text.starts_with("/*") && text.ends_with("*/");
  }

  /// Complains about the present line. Complaints with the same text about several lines become one
  /// error.
  void complain(const std::string& message) {
    const auto [known, is_new] = repeated_.emplace(message, std::pair(errors_.size(), 0));
    if (!is_new) {
      ++known->second.second;
      return;
    }
    errors_.push_back({ErrorKind::BadInput, message, file_ + ":" + std::to_string(number_)});
  }

  std::vector<Error> counted() {
    for (const auto& [message, place] : repeated_) {
      const auto& [index, more] = place;
      if (more == 0) continue;
      errors_[index].message += "; the same in " + swarmsmith::counted(more, "more line");
    }
    return std::move(errors_);
  }

  void begin(std::string_view text, std::size_t at) {
    if (const auto complaint = complaint_about_name(text.substr(0, at))) complain(*complaint);
    in_genome_ = text.substr(at).starts_with(kGenomeStart) &&
                 text.find(kGenomeEnd, at) == std::string_view::npos;
    FiledMachine machine{.head = {},
                         .name = std::string(trimmed(text.substr(0, at))),
                         .text = std::string(text.substr(at)),
                         .place = file_ + ":" + std::to_string(number_)};
    if (has_head_) machine.head = read_head(toml_, file_, errors_);
    machines_.push_back(std::move(machine));
    toml_.assign(number_, '\n');
    has_head_ = false;
  }

  std::string file_;
  std::size_t number_ = 0;
  std::string toml_;  ///< head of the next machine
  bool has_head_ = false;
  bool in_genome_ = false;
  std::vector<FiledMachine> machines_;
  std::vector<Error> errors_;
  /// For each complaint text, the index of its error and the number of further lines with it.
  std::map<std::string, std::pair<std::size_t, std::size_t>> repeated_;
};

/// The tables of values that are not built in.
std::vector<Section> tables_of(const MachineHead& head, Section& top) {
  std::vector<Section> tables;
  if (head.own_flavour != nullptr) tables = flavour_sections(*head.own_flavour, "flavour");
  if (head.profile) {
    const auto built_in = built_in_profile(head.profile->name);
    if (built_in && *built_in == *head.profile) {
      top.lines.push_back({"profile", quoted_text(head.profile->name)});
    } else {
      for (Section& section : profile_sections(*head.profile, "profile"))
        tables.push_back(std::move(section));
    }
  }
  if (!head.mission) return tables;
  const auto built_in = built_in_mission(head.mission->mission.name);
  if (built_in && *built_in == head.mission->mission) {
    top.lines.push_back({"mission", quoted_text(head.mission->mission.name)});
    return tables;
  }
  for (Section& section : mission_sections(*head.mission))
    tables.push_back(std::move(section));
  return tables;
}

}  // namespace

tl::expected<std::vector<FiledMachine>, std::vector<Error>> parse_machine_file(
    std::string_view text, const std::filesystem::path& file) {
  if (const auto kind = foreign_kind(text)) {
    return tl::unexpected(std::vector{Error{
        ErrorKind::BadInput,
        "this is " + *kind + "; expected machines, trees or networks as texts (docs/machines.md)",
        file.string()}});
  }
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  Reader reader(file.string());
  for (const std::string_view line : split_lines(text))
    reader.take(line);
  return reader.finish();
}

std::string head_text(const MachineHead& head) {
  Section top{.header = "", .prefix = "", .lines = {{"format", "1"}}};
  const auto say = [&top](const char* key, const std::string& value) {
    if (!value.empty()) top.lines.push_back({key, quoted_text(value)});
  };
  if (head.own_flavour == nullptr) say("flavour", head.flavour);
  if (head.turn_clock) say("turn_clock", std::string(name_of(*head.turn_clock)));
  std::vector<Section> sections = tables_of(head, top);
  say("method", head.method);
  say("design", head.design);
  say("candidate", head.candidate);
  say("campaign", head.campaign);
  say("seeds", head.seeds);
  sections.insert(sections.begin(), std::move(top));
  std::string lines;
  const std::string toml = text_of(sections);
  for (const std::string_view line : split_lines(toml))
    lines += line.empty() ? "#:\n" : "#: " + std::string(line) + "\n";
  return lines;
}

}  // namespace swarmsmith
