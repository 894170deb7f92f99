#include "coordinator/campaign/internal/method_search.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>

namespace swarmsmith {
namespace {

struct Preset {
  std::string_view name;
  Architecture architecture;
  SearchKind search;
};

/// Methods from the literature (docs/methods.md).
constexpr std::array kPresets = {
    Preset{"random", Architecture::Machine, SearchKind::Random},
    Preset{"vanilla", Architecture::Machine, SearchKind::FRace},
    Preset{"evostick", Architecture::Network, SearchKind::Evolution},
    Preset{"cma-es", Architecture::Network, SearchKind::CmaEs},
    Preset{"icepop", Architecture::Machine, SearchKind::Annealing},
    Preset{"maple", Architecture::Tree, SearchKind::Irace},
};

constexpr std::array kArchitectures = {Architecture::Machine, Architecture::Tree,
                                       Architecture::Network};

std::vector<std::string> search_names() {
  std::vector<std::string> names;
  for (const SearchKind kind : all_searches())
    names.emplace_back(name_of(kind));
  return names;
}

/// Reads the architecture and the search, given as a preset or separately.
void read_pair(TableReader& table, Method& method, bool is_file) {
  std::vector<std::string> presets;
  presets.reserve(std::size(kPresets));
  for (const Preset& preset : kPresets)
    presets.emplace_back(preset.name);
  std::vector<std::string> architectures;
  architectures.reserve(std::size(kArchitectures));
  for (const Architecture architecture : kArchitectures)
    architectures.emplace_back(name_of(architecture));
  if (const auto name = table.choice("method", presets)) {
    const auto* preset = std::ranges::find(kPresets, *name, &Preset::name);
    method.architecture = preset->architecture;
    method.search = search_of(preset->search);
    for (const std::string_view key : {"architecture", "search"}) {
      table.take(key);
      if (!table.has(key)) continue;
      table.complain(key, "`method = \"" + *name + "\"` sets architecture and search already: " +
                              std::string(name_of(method.architecture)) + " and " +
                              std::string(name_of(kind_of(method.search))) +
                              "; leave one of them out");
    }
  } else {
    if (const auto said = table.choice("architecture", architectures)) {
      method.architecture = kArchitectures.at(static_cast<std::size_t>(
          std::ranges::find(architectures, *said) - architectures.begin()));
    }
    if (const auto said = table.choice("search", search_names())) {
      method.search = search_of(
          *std::ranges::find(all_searches(), *said, [](SearchKind kind) { return name_of(kind); }));
    }
  }
  if (words_of(method.search).wants_reals && !is_file && method.baseline.empty() &&
      method.architecture != Architecture::Network) {
    table.complain("search", "the search " + std::string(name_of(kind_of(method.search))) +
                                 " needs reals without conditions, such as the weights of "
                                 "networks (`architecture = \"network\"`), and a " +
                                 std::string(name_of(method.architecture)) +
                                 " has modules to choose");
  }
  if (is_file && method.architecture != Architecture::Machine) {
    table.complain(
        table.has("method") ? "method" : "architecture",
        "a parameter file defines what is searched; a method with one has a `search` and no "
        "architecture");
  }
}

/// Reads each key of a search's table.
class OptionReader {
 public:
  explicit OptionReader(TableReader& table) : table_(table) {}

  void operator()(const SearchField& field, std::int64_t& value) {
    const auto read = table_.integer(
        field.key, {static_cast<std::int64_t>(field.least), static_cast<std::int64_t>(field.most)});
    value = read.value_or(value);
  }
  void operator()(const SearchField& field, double& value) {
    value = table_.number(field.key, {field.least, field.most}).value_or(value);
  }
  void operator()(const SearchField& field, bool& value) {
    value = table_.boolean(field.key).value_or(value);
  }
  template <class Value>
  requires std::is_enum_v<Value>
  void operator()(const SearchField& field, Value& value) {
    const std::vector<std::string> choices(field.choices.begin(), field.choices.end());
    if (const auto read = table_.choice(field.key, choices))
      value = static_cast<Value>(std::ranges::find(choices, *read) - choices.begin());
  }

 private:
  TableReader& table_;
};

/// Writes the same keys as lines.
class OptionLines {
 public:
  std::vector<SectionLine> lines;

  void operator()(const SearchField& field, std::int64_t value) {
    add(field, std::to_string(value));
  }
  void operator()(const SearchField& field, double value) { add(field, number_text(value)); }
  void operator()(const SearchField& field, bool value) { add(field, value ? "true" : "false"); }
  template <class Value>
  requires std::is_enum_v<Value>
  void operator()(const SearchField& field, const Value& value) {
    add(field, quoted_text(field.choices[static_cast<std::size_t>(value)]));
  }

 private:
  void add(const SearchField& field, std::string value) {
    lines.push_back({std::string(field.key), std::move(value)});
  }
};

/// [method.evolution] and so on: only the table of the method's own search is allowed.
void read_numbers(TableReader& table, Method& method) {
  const SearchKind own = kind_of(method.search);
  for (const SearchKind kind : all_searches()) {
    const std::string name(name_of(kind));
    if (kind == SearchKind::Irace) {
      if (table.has(name)) {
        table.take(name);
        table.complain(name, "[method.irace] has no keys: irace's settings are in [race]");
      }
      continue;
    }
    table.take(name);
    if (!table.has(name)) continue;
    if (kind != own) {
      table.complain(name, "[method." + name + "] is for the search " + name +
                               ", and this method's search is " + std::string(name_of(own)));
      continue;
    }
    auto options = table.table(name);
    if (!options) continue;
    OptionReader reader(*options);
    visit_search_fields(method.search, reader);
    for (const SearchFault& fault : faults_of(method.search)) {
      const auto said =
          std::ranges::find_if(fault.keys, [&](std::string_view key) { return options->has(key); });
      options->complain(said != fault.keys.end() ? *said : fault.keys.back(), fault.message);
    }
    options->finish();
  }
}

void read_network(TableReader& table, Method& method) {
  const bool is_network = method.architecture == Architecture::Network;
  const auto flavour = flavour_of(method);
  const bool has_strengths =
      flavour && (*flavour)->obstacles.reading == ObstacleModel::Reading::AsSensed;
  if (flavour && (*flavour)->find(Module::Phototaxis) != nullptr)
    method.inputs = has_strengths ? NetworkInputs::Rm11 : NetworkInputs::Rm12;
  table.take("network");
  if (!table.has("network")) return;
  if (!is_network) {
    table.complain("network",
                   "[method.network] is for networks, and this method's architecture is " +
                       std::string(name_of(method.architecture)));
    return;
  }
  auto network = table.table("network");
  if (!network) return;
  static const std::vector<std::string> kInputs = {
      std::string(name_of(NetworkInputs::Rvr)), std::string(name_of(NetworkInputs::RvrGray)),
      std::string(name_of(NetworkInputs::Rm12)), std::string(name_of(NetworkInputs::Rm11))};
  if (const auto inputs = network->choice("inputs", kInputs)) {
    method.inputs = *network_inputs_from(*inputs);
    if (method.inputs == NetworkInputs::Rm12 && flavour &&
        (*flavour)->find(Module::Phototaxis) == nullptr) {
      network->complain("inputs", "the inputs rm1.2 read light sensors, which the flavour " +
                                      method.flavour + " does not have: use rvr or rvr-gray");
    }
    if (method.inputs == NetworkInputs::Rm11 && flavour && !has_strengths) {
      network->complain("inputs",
                        "the inputs rm1.1 are strengths of single sensors, which the flavour " +
                            method.flavour + " does not have: use other inputs");
    }
  }
  if (const auto most = network->number("most_weight", {0.01, 1000})) method.most_weight = *most;
  network->finish();
}

}  // namespace

void read_search(TableReader& table, Method& method, bool is_file) {
  read_pair(table, method, is_file);
  read_numbers(table, method);
  if (!is_file) read_network(table, method);
}

std::vector<SectionLine> search_lines(const Method& method) {
  std::vector<SectionLine> lines;
  if (method.architecture != Architecture::Machine)
    lines.push_back({"architecture", quoted_text(name_of(method.architecture))});
  if (kind_of(method.search) != SearchKind::Irace)
    lines.push_back({"search", quoted_text(name_of(kind_of(method.search)))});
  return lines;
}

std::vector<Section> search_sections(const Method& method, const std::string& prefix) {
  std::vector<Section> sections;
  if (method.architecture == Architecture::Network) {
    sections.push_back({"[method.network]",
                        prefix + "network.",
                        {{"inputs", quoted_text(name_of(method.inputs))},
                         {"most_weight", number_text(method.most_weight)}}});
  }
  const SearchKind kind = kind_of(method.search);
  if (kind == SearchKind::Irace) return sections;
  const std::string name(name_of(kind));
  Section section{"[method." + name + "]", prefix + name + ".", {}};
  OptionLines options;
  visit_search_fields(method.search, options);
  section.lines = std::move(options.lines);
  sections.push_back(std::move(section));
  return sections;
}

}  // namespace swarmsmith
