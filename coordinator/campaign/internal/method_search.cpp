#include "coordinator/campaign/internal/method_search.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace swarmsmith {
namespace {

struct Preset {
  std::string_view name;
  Architecture architecture;
  SearchKind search;
};

/// The methods of the literature (docs/methods.md).
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

/// A number of a search's table: an integer or a real of the options.
struct Number {
  SearchKind search;
  std::string_view key;
  std::variant<std::int64_t& (*)(SearchOptions&), double& (*)(SearchOptions&)> of;
  double least;
  double most;
};

constexpr double kMost = 1'000'000;

const std::array kNumbers = {
    Number{SearchKind::Random, "runs",
           +[](SearchOptions& o) -> std::int64_t& { return o.random.runs; }, 1, kMost},
    Number{SearchKind::Random, "finalists",
           +[](SearchOptions& o) -> std::int64_t& { return o.random.finalists; }, 0, kMost},
    Number{SearchKind::Random, "final_runs",
           +[](SearchOptions& o) -> std::int64_t& { return o.random.final_runs; }, 1, kMost},
    Number{SearchKind::FRace, "configurations",
           +[](SearchOptions& o) -> std::int64_t& { return o.f_race.configurations; }, 0, kMost},
    Number{SearchKind::Evolution, "population",
           +[](SearchOptions& o) -> std::int64_t& { return o.evolution.population; }, 2, kMost},
    Number{SearchKind::Evolution, "runs",
           +[](SearchOptions& o) -> std::int64_t& { return o.evolution.runs; }, 1, kMost},
    Number{SearchKind::Evolution, "parents",
           +[](SearchOptions& o) -> double& { return o.evolution.parents; }, 0, 1},
    Number{SearchKind::Evolution, "elites",
           +[](SearchOptions& o) -> double& { return o.evolution.elites; }, 0, 1},
    Number{SearchKind::Evolution, "step",
           +[](SearchOptions& o) -> double& { return o.evolution.step; }, 0, 10},
    Number{SearchKind::Evolution, "final_runs",
           +[](SearchOptions& o) -> std::int64_t& { return o.evolution.final_runs; }, 0, kMost},
    Number{SearchKind::CmaEs, "population",
           +[](SearchOptions& o) -> std::int64_t& { return o.cma_es.population; }, 4, kMost},
    Number{SearchKind::CmaEs, "runs",
           +[](SearchOptions& o) -> std::int64_t& { return o.cma_es.runs; }, 1, kMost},
    Number{SearchKind::CmaEs, "step", +[](SearchOptions& o) -> double& { return o.cma_es.step; },
           1e-6, 10},
    Number{SearchKind::CmaEs, "final_runs",
           +[](SearchOptions& o) -> std::int64_t& { return o.cma_es.final_runs; }, 0, kMost},
    Number{SearchKind::Annealing, "window",
           +[](SearchOptions& o) -> std::int64_t& { return o.annealing.window; }, 1, kMost},
    Number{SearchKind::Annealing, "moved",
           +[](SearchOptions& o) -> std::int64_t& { return o.annealing.moved; }, 1, kMost},
    Number{SearchKind::Annealing, "start_temperature",
           +[](SearchOptions& o) -> double& { return o.annealing.start_temperature; }, 0, 1e6},
    Number{SearchKind::Annealing, "end_temperature",
           +[](SearchOptions& o) -> double& { return o.annealing.end_temperature; }, 0, 1e6},
    Number{SearchKind::Annealing, "final_runs",
           +[](SearchOptions& o) -> std::int64_t& { return o.annealing.final_runs; }, 1, kMost},
};

const std::vector<std::string> kMutations = {"neat", "normal"};
const std::vector<std::string> kCoolings = {"geometric", "published"};

std::vector<std::string> search_names() {
  std::vector<std::string> names;
  for (const SearchKind kind : all_searches())
    names.emplace_back(name_of(kind));
  return names;
}

/// The architecture and the search, by preset or one by one.
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
    method.search.kind = preset->search;
    for (const std::string_view key : {"architecture", "search"}) {
      table.take(key);
      if (!table.has(key)) continue;
      table.complain(key, "`method = \"" + *name + "\"` says architecture and search already: " +
                              std::string(name_of(method.architecture)) + " and " +
                              std::string(name_of(method.search.kind)) + "; leave one of them out");
    }
  } else {
    if (const auto said = table.choice("architecture", architectures)) {
      method.architecture = kArchitectures.at(static_cast<std::size_t>(
          std::ranges::find(architectures, *said) - architectures.begin()));
    }
    if (const auto said = table.choice("search", search_names())) {
      method.search.kind =
          *std::ranges::find(all_searches(), *said, [](SearchKind kind) { return name_of(kind); });
    }
  }
  const bool wants_reals =
      method.search.kind == SearchKind::Evolution || method.search.kind == SearchKind::CmaEs;
  if (wants_reals && !is_file && method.baseline.empty() &&
      method.architecture != Architecture::Network) {
    table.complain("search", "the search " + std::string(name_of(method.search.kind)) +
                                 " needs reals without conditions, such as the weights of "
                                 "networks (`architecture = \"network\"`), and a " +
                                 std::string(name_of(method.architecture)) +
                                 " has modules to choose");
  }
  if (is_file && method.architecture != Architecture::Machine) {
    table.complain(
        table.has("method") ? "method" : "architecture",
        "a parameter file says what is searched; a method with one has a `search` and no "
        "architecture");
  }
}

/// The published schedule has temperatures of its own. The usual values may stand there, as they do
/// in the text that stores have.
void refuse_temperatures_of_others(TableReader& options, const AnnealingOptions& read) {
  if (read.cooling != Cooling::Published) return;
  const AnnealingOptions usual;
  for (const auto& [key, member] :
       {std::pair{"start_temperature", &AnnealingOptions::start_temperature},
        std::pair{"end_temperature", &AnnealingOptions::end_temperature}}) {
    if (!options.has(key) || read.*member == usual.*member) continue;
    options.complain(key, "`" + std::string(key) +
                              "` is of geometric cooling; the published one begins at 125 score "
                              "units, and again whenever it is below 0.00125");
  }
}

/// [method.evolution] and so on: only that of the method's own search.
void read_numbers(TableReader& table, Method& method) {
  const SearchKind own = method.search.kind;
  for (const SearchKind kind : all_searches()) {
    const std::string name(name_of(kind));
    if (kind == SearchKind::Irace) {
      if (table.has(name)) {
        table.take(name);
        table.complain(name, "[method.irace] has no keys: what irace goes by is in [race]");
      }
      continue;
    }
    table.take(name);
    if (!table.has(name)) continue;
    if (kind != own) {
      table.complain(name, "[method." + name + "] is of the search " + name +
                               ", and this method's search is " + std::string(name_of(own)));
      continue;
    }
    auto options = table.table(name);
    if (!options) continue;
    for (const Number& number : kNumbers) {
      if (number.search != kind) continue;
      if (const auto* whole = std::get_if<0>(&number.of)) {
        const auto value = options->integer(number.key, {static_cast<std::int64_t>(number.least),
                                                         static_cast<std::int64_t>(number.most)});
        if (value) (*whole)(method.search) = *value;
      } else if (const auto value = options->number(number.key, {number.least, number.most})) {
        std::get<1>(number.of)(method.search) = *value;
      }
    }
    if (kind == SearchKind::FRace && method.search.f_race.configurations == 1) {
      options->complain("configurations",
                        "`configurations` must be 0 (automatic) or at least 2, this is 1");
    }
    if (kind == SearchKind::Evolution) {
      if (const auto mutation = options->choice("mutation", kMutations))
        method.search.evolution.mutation = *mutation == "neat" ? Mutation::Neat : Mutation::Normal;
      const EvolutionOptions& read = method.search.evolution;
      if (read.elites > read.parents) {
        options->complain(options->has("elites") ? "elites" : "parents",
                          "`elites` (" + number_text(read.elites) + ") is at most `parents` (" +
                              number_text(read.parents) +
                              "): who goes on unchanged has children, too");
      }
    }
    if (kind == SearchKind::Annealing) {
      if (const auto cooling = options->choice("cooling", kCoolings))
        method.search.annealing.cooling =
            *cooling == "geometric" ? Cooling::Geometric : Cooling::Published;
      if (const auto random = options->boolean("start_at_random"))
        method.search.annealing.start_at_random = *random;
      if (method.search.annealing.moved > method.search.annealing.window)
        options->complain("moved", "`moved` is at most `window`: a window moves on by parts of it");
      const AnnealingOptions& read = method.search.annealing;
      refuse_temperatures_of_others(*options, read);
      if (read.start_temperature > 0 && read.end_temperature > read.start_temperature) {
        options->complain(options->has("end_temperature") ? "end_temperature" : "start_temperature",
                          "`end_temperature` (" + number_text(read.end_temperature) +
                              ") is at most `start_temperature` (" +
                              number_text(read.start_temperature) + "): annealing cools");
      }
    }
    options->finish();
  }
}

void read_network(TableReader& table, Method& method) {
  const bool is_network = method.architecture == Architecture::Network;
  const auto flavour = flavour_of(method);
  if (flavour && (*flavour)->find(Module::Phototaxis) != nullptr)
    method.inputs = NetworkInputs::Rm12;
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
  static const std::vector<std::string> kInputs = {std::string(name_of(NetworkInputs::Rvr)),
                                                   std::string(name_of(NetworkInputs::RvrGray)),
                                                   std::string(name_of(NetworkInputs::Rm12))};
  if (const auto inputs = network->choice("inputs", kInputs)) {
    method.inputs = *network_inputs_from(*inputs);
    if (method.inputs == NetworkInputs::Rm12 && flavour &&
        (*flavour)->find(Module::Phototaxis) == nullptr) {
      network->complain("inputs", "the inputs rm1.2 read light sensors, which the flavour " +
                                      method.flavour + " has not: take rvr or rvr-gray");
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
  if (method.search.kind != SearchKind::Irace)
    lines.push_back({"search", quoted_text(name_of(method.search.kind))});
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
  const SearchKind kind = method.search.kind;
  if (kind == SearchKind::Irace) return sections;
  const std::string name(name_of(kind));
  Section section{"[method." + name + "]", prefix + name + ".", {}};
  SearchOptions options = method.search;
  for (const Number& number : kNumbers) {
    if (number.search != kind) continue;
    const auto* whole = std::get_if<0>(&number.of);
    section.lines.push_back(
        {std::string(number.key), whole != nullptr ? std::to_string((*whole)(options))
                                                   : number_text(std::get<1>(number.of)(options))});
  }
  if (kind == SearchKind::Evolution) {
    const bool is_neat = options.evolution.mutation == Mutation::Neat;
    section.lines.push_back({"mutation", quoted_text(kMutations[is_neat ? 0 : 1])});
  }
  if (kind == SearchKind::Annealing) {
    const bool is_geometric = options.annealing.cooling == Cooling::Geometric;
    section.lines.push_back({"cooling", quoted_text(kCoolings[is_geometric ? 0 : 1])});
    section.lines.push_back(
        {"start_at_random", options.annealing.start_at_random ? "true" : "false"});
  }
  sections.push_back(std::move(section));
  return sections;
}

}  // namespace swarmsmith
