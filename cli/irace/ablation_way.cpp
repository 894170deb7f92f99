#include "cli/irace/ablation_way.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/plain_text.h"
#include "base/text/whole_file.h"
#include "cli/irace/stored_configurations.h"
#include "irace_core/files/configurations_file.h"

namespace swarmsmith::cli {
namespace {

constexpr const char* kSource = "--ablation-source";
constexpr const char* kTarget = "--ablation-target";

std::optional<std::int64_t> id_of(const std::string& text) {
  constexpr std::size_t kMostDigits = 15;
  const bool is_id = !text.empty() && text.size() <= kMostDigits &&
                     text.find_first_not_of("0123456789") == std::string::npos;
  return is_id ? std::optional(std::stoll(text)) : std::nullopt;
}

/// Reads a file with one configuration.
Expected<Configuration> read_configuration(const IraceSetting& setting, const std::string& name,
                                           const IraceSetup& setup, const std::string& option) {
  const std::filesystem::path file = absolute_path(name, setting.folder);
  auto text = read_whole_file(file);
  if (!text) {
    Error error = text.error();
    error.message +=
        fmt::format(" ({} takes the id of a configuration, or a file with one)", option);
    return Unexpected(std::move(error));
  }
  const auto read = parse_configurations_file({std::move(*text), file.string()}, setup.space);
  if (!read) return Unexpected(read.error());
  if (read->size() == 1) return read->front();
  return bad_input(
      fmt::format("has {}, and {} takes one", counted(read->size(), "configuration"), option),
      file.string());
}

struct RSwitch {
  std::string_view brief;
  std::string_view name;
  std::string_view ours;    ///< empty: there is no such option
  std::string_view advice;  ///< what to use instead if there is no such option
};

constexpr std::array<RSwitch, 10> kSwitches = {
    {{"-S", "--src", kSource, ""},
     {"-T", "--target", kTarget, ""},
     {"-t", "--type", "--ablation-type", ""},
     {"-n", "--n-instances", "--ablation-instances", ""},
     {"-o", "--output-file", "",
      "leave it out: the store keeps it, and --ablation-csv FILE has all runs"},
     {"-P", "--params", "",
      "leave it out: all parameters that differ are tried; to keep some, change them in the file "
      "that "
      "--ablation-source or --ablation-target names"},
     {"-O", "--plot-type", "",
      "leave it out: `swarmsmith figure ablation STORE -o FILE.pdf` draws it"},
     {"", "--plot", "", "leave it out: `swarmsmith figure ablation STORE -o FILE.pdf` draws it"},
     {"", "--old-path", "", "leave it out: the scenario says where files are"},
     {"", "--new-path", "", "leave it out: the scenario says where files are"}}};

}  // namespace

Expected<AblationWay> ablation_way(const IraceSettings& settings, const IraceSetup& setup,
                                   const std::filesystem::path& finished) {
  const auto stored = read_stored_configurations(finished, setup.space);
  if (!stored) return Unexpected(stored.error());
  AblationWay way{.from = "1",
                  .to = std::to_string(stored->elites.rbegin()->second.front()),
                  .source = {},
                  .target = {}};
  for (const auto& [option, name, end] :
       {std::tuple{kSource, &way.from, &way.source}, std::tuple{kTarget, &way.to, &way.target}}) {
    const IraceSetting* setting = settings.find(option);
    if (const auto text = settings.text(option); text && !text->empty()) *name = *text;
    const auto id = id_of(*name);
    auto found =
        id ? stored->find(*id, option) : read_configuration(*setting, *name, setup, option);
    if (!found) return Unexpected(found.error());
    *end = std::move(*found);
  }
  if (way.source != way.target) return way;
  return bad_input(fmt::format("configurations {} and {} are the same: name others with "
                               "--ablation-source and --ablation-target",
                               way.from, way.to),
                   "--ablation");
}

std::string ablation_ending(const IraceSettings& settings, AblationType type) {
  std::string ending = "-ablation";
  if (type == AblationType::Racing) ending += "-racing";
  if (const auto number = settings.number("--ablation-instances"))
    ending += "-x" + std::to_string(*number);
  for (const auto& [option, sign] : {std::pair{kSource, "-from"}, std::pair{kTarget, "-to"}}) {
    const auto text = settings.text(option);
    if (!text || text->empty()) continue;
    ending += sign + (id_of(*text) ? *text : "-" + std::filesystem::path(*text).stem().string());
  }
  return ending;
}

Expected<std::vector<std::string>> words_of_r_ablation(std::vector<std::string> words) {
  for (std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    const auto found = std::ranges::find_if(kSwitches, [&](const RSwitch& one) {
      return name == one.name || (!one.brief.empty() && name == one.brief);
    });
    if (found == kSwitches.end()) continue;
    if (found->ours.empty())
      return bad_input("exists only in R's irace: " + std::string(found->advice), name);
    word.replace(0, name.size(), found->ours);
  }
  return words;
}

}  // namespace swarmsmith::cli
