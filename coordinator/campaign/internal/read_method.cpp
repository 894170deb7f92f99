#include "coordinator/campaign/internal/read_method.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/suggestion.h"
#include "base/text/whole_file.h"
#include "coordinator/campaign/internal/method_search.h"
#include "irace_core/files/configurations_file.h"
#include "irace_core/files/parameter_file.h"
#include "sim/control/flavour.h"
#include "sim/control/flavour_file.h"
#include "sim/control/machine.h"
#include "sim/files/machine_file.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {
namespace {

std::vector<std::string> ids_of(const std::vector<ModuleSpec>& table) {
  std::vector<std::string> ids;
  ids.reserve(table.size());
  for (const ModuleSpec& spec : table)
    ids.push_back(spec.id);
  return ids;
}

/// Reads a flavour from the file that the key names, or from a table; null after a complaint.
const Flavour* read_own_flavour(TableReader& table, const std::string* word,
                                const std::filesystem::path& folder, Method& method) {
  const std::size_t before = table.complaints();
  Flavour flavour;
  if (word != nullptr) {
    auto read = find_flavour_file(*word, folder);
    if (!read) {
      for (Error& error : read.error())
        table.complain_foreign("flavour", std::move(error));
      return nullptr;
    }
    flavour = std::move(*read);
  } else if (auto own = table.table("flavour")) {
    flavour = read_flavour_table(*own);
  }
  if (table.complaints() > before) return nullptr;
  method.flavour = flavour.name;
  method.own_flavour = kept_flavour(std::move(flavour));
  return *flavour_of(method);
}

/// Null after a complaint if the flavour is unknown: then its modules cannot be checked.
const Flavour* read_flavour(TableReader& table, const std::filesystem::path& folder,
                            Method& method) {
  const Node* said = table.has("flavour") ? table.take("flavour") : nullptr;
  const auto* word = said != nullptr ? std::get_if<std::string>(&said->value) : nullptr;
  if (said != nullptr &&
      (word != nullptr ? names_a_file(*word) : std::holds_alternative<Table>(said->value))) {
    return read_own_flavour(table, word, folder, method);
  }
  if (word != nullptr && *word == "vanilla") {
    table.complain("flavour",
                   "vanilla is a search, not a flavour: write `method = \"vanilla\"` and "
                   "the flavour that it searches");
    return nullptr;
  }
  const auto name = table.choice("flavour", flavour_names());
  if (!name && table.has("flavour")) return nullptr;
  method.flavour = name.value_or(method.flavour);
  return *flavour_of(method);
}

/// The unit of Exploration's turns; without the key, the flavour's own.
TurnClock read_turn_clock(TableReader& table, const Flavour& flavour) {
  static const std::vector<std::string> kNames = {std::string(name_of(TurnClock::Cycles)),
                                                  std::string(name_of(TurnClock::Seconds))};
  const auto name = table.choice("turn_clock", kNames);
  if (!name) return flavour.exploration.turn_clock;
  return *name == kNames[0] ? TurnClock::Cycles : TurnClock::Seconds;
}

/// The modules that the key names, in the order of the flavour's table, so that the order in the
/// file does not matter; without the key, the whole table.
std::vector<std::string> read_modules(TableReader& table, std::string_view key,
                                      const std::vector<ModuleSpec>& known,
                                      const std::string& flavour) {
  const std::vector<std::string> ids = ids_of(known);
  const auto named = table.texts(key);
  if (!named) return ids;
  for (std::size_t i = 0; i < named->size(); ++i) {
    const std::string& name = (*named)[i];
    if (std::ranges::find(ids, name) == ids.end()) {
      table.complain(key, "flavour " + flavour + " has no " + std::string(key.substr(0, 9)) + " `" +
                              name + "`" + did_you_mean(name, ids) + "; it has: " + joined(ids));
    }
    const auto before = named->begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(named->begin(), before, name) != before) {
      table.complain(key, "`" + std::string(key) + "` names `" + name + "` twice");
    }
  }
  if (named->empty()) table.complain(key, "`" + std::string(key) + "` is empty");
  std::vector<std::string> chosen;
  for (const std::string& id : ids) {
    if (std::ranges::find(*named, id) != named->end()) chosen.push_back(id);
  }
  return chosen;
}

/// Reads one range, `{ int = [1, 100] }` or `{ real = [1, 5] }`.
std::optional<RangeOverride> read_range(TableReader& entry, const ModuleSpec& module,
                                        const ParameterSpec& parameter) {
  const bool real = parameter.type == ParameterSpec::Type::Real;
  const std::string type = real ? "real" : "int";
  const std::string other = real ? "int" : "real";
  const std::string name = module.id + "." + parameter.name;
  if (entry.has(other)) {
    entry.take(other);
    entry.complain(other, name + " is not of type " + other + "; write { " + type + " = [...] }");
  }
  if (entry.has("digits")) {
    entry.take("digits");
    entry.complain("digits",
                   "digits for one parameter are not supported yet; `digits` in [race] holds "
                   "for all reals");
  }
  const auto range = entry.interval(type);
  if (!entry.has(type) && !entry.has(other)) {
    entry.complain(type, name + " needs a range: { " + type + " = [lowest, highest] }");
  }
  entry.finish();
  if (!range) return std::nullopt;
  for (const double bound : {range->least, range->most}) {
    if (const auto complaint = complaint_about(parameter, bound)) {
      entry.complain(type, name + ": " + *complaint + ", this is " + number_text(bound));
      return std::nullopt;
    }
  }
  if (range->least >= range->most) {
    entry.complain(type, name + ": the range's lower end must be below its upper end");
    return std::nullopt;
  }
  return RangeOverride{module.id, parameter.name, range->least, range->most};
}

/// Reads all ranges of one module: `exploration.tau = ...`.
void read_module_ranges(TableReader& table, const ModuleSpec& module, Method& method) {
  std::vector<std::string> known;
  for (const ParameterSpec& parameter : module.parameters) {
    known.push_back(parameter.name);
    if (!table.has(parameter.name)) continue;
    if (parameter.type == ParameterSpec::Type::Label) {
      table.take(parameter.name);
      table.complain(
          parameter.name,
          "a label is one of the flavour's colours; a choice among them is not supported yet");
      continue;
    }
    auto entry = table.table(parameter.name);
    if (!entry) continue;
    if (auto range = read_range(*entry, module, parameter)) {
      method.ranges.push_back(std::move(*range));
    }
  }
  for (const auto& [key, node] : table.take_all()) {
    table.complain(key, module.id + " has no parameter `" + key + "`" + did_you_mean(key, known) +
                            (known.empty() ? "" : "; it has: " + joined(known)));
  }
}

/// [method.parameters]: allowed only for modules that the method uses.
void read_ranges(TableReader& table, const Flavour& flavour, Method& method) {
  std::vector<std::string> used = method.behaviours;
  used.insert(used.end(), method.conditions.begin(), method.conditions.end());
  for (const auto& [id, node] : table.take_all()) {
    const ModuleSpec* module = flavour.find(id);
    if (module == nullptr || std::ranges::find(used, id) == used.end()) {
      table.complain(id, "the method has no module `" + id + "`" + did_you_mean(id, used) +
                             "; it has: " + joined(used));
      continue;
    }
    if (auto ranges = table.table(id)) read_module_ranges(*ranges, *module, method);
  }
}

/// Reads the text from the file that the key names, or, as in stores, from the key plus `_text`.
std::string read_text(TableReader& table, const std::string& key,
                      const std::filesystem::path& folder, const std::string& what) {
  if (auto text = table.text(key + "_text")) return std::move(*text);
  const auto name = table.text(key);
  if (!name) return {};
  auto text = read_file(folder / *name, what);
  if (text) return std::move(*text);
  table.complain_foreign(key, text.error());
  return {};
}

/// The name of a key's text in error messages: the file's path, or the key of the text itself.
std::string text_name(TableReader& table, const std::string& key,
                      const std::filesystem::path& folder) {
  const Node* node = table.take(key);
  const auto* name = node != nullptr ? std::get_if<std::string>(&node->value) : nullptr;
  return name != nullptr ? (folder / *name).string() : key + "_text";
}

/// Reads a method whose space comes from an irace parameter file.
void read_parameter_file(TableReader& table, const std::filesystem::path& folder, Method& method) {
  method.flavour.clear();
  method.max_states = method.max_transitions = 0;
  const std::size_t before = table.complaints();
  method.parameters = read_text(table, "parameters", folder, "parameters");
  method.configurations = read_text(table, "configurations", folder, "configurations");
  table.finish();
  if (table.complaints() > before) return;
  auto parameters = parse_parameter_file(
      {.parameters = {method.parameters, text_name(table, "parameters", folder)}});
  if (!parameters) return table.complain_foreign("parameters", std::move(parameters.error()));
  if (method.configurations.empty()) return;
  auto initial = parse_configurations_file(
      {method.configurations, text_name(table, "configurations", folder)}, parameters->space);
  if (!initial) table.complain_foreign("configurations", std::move(initial.error()));
}

/// Whether the method names a parameter file instead of a flavour.
bool has_parameter_file(TableReader& table) {
  if (table.has("parameters_text")) return true;
  if (!table.has("parameters")) return false;
  return std::holds_alternative<std::string>(table.take("parameters")->value);
}

/// The only machine in the file that the key names; complains if there is not exactly one.
std::optional<FiledMachine> read_filed_machine(TableReader& table, const std::string& name,
                                               const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / name;
  const auto text = read_file(file, "machine");
  if (!text) {
    table.complain_foreign("baseline", text.error());
    return std::nullopt;
  }
  auto machines = parse_machine_file(*text, file);
  if (!machines) {
    table.complain_foreign("baseline", machines.error().front());
    return std::nullopt;
  }
  if (machines->size() > 1) {
    table.complain("baseline", "`baseline` is one machine, and " + file.string() + " has " +
                                   std::to_string(machines->size()));
    return std::nullopt;
  }
  return std::move(machines->front());
}

/// Takes the settings of the machine's head for keys that the method does not set.
void follow_head(TableReader& table, const MachineHead& head, Method& method) {
  if (head.flavour.empty()) return;
  if (!table.has("flavour")) {
    method.flavour = head.flavour;
    method.own_flavour = head.own_flavour;
  } else if (method.flavour != head.flavour) {
    table.complain("baseline", "the machine was designed for the flavour " + head.flavour +
                                   ", the method has " + method.flavour);
  } else if (method.own_flavour != head.own_flavour) {
    table.complain("baseline", "the machine was designed for another flavour " + head.flavour +
                                   " than the method has: the files differ");
  }
}

std::string lower_case(std::string text) {
  for (char& letter : text)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return text;
}

/// Reads a `baseline` given as text or as a file; does nothing for a race or a random machine.
void read_baseline(TableReader& table, const std::filesystem::path& folder, Method& method) {
  const auto baseline = table.text("baseline");
  if (!baseline) return;
  method.baseline = *baseline;
  for (const std::string_view key : {"method", "search"}) {
    if (!table.has(key)) continue;
    table.complain(key, "`" + std::string(key) +
                            "` says how control software is searched for, and a `baseline` is not "
                            "searched for");
  }
  if (method.baseline == kRandomMachine) return;
  if (!baseline->starts_with("--") && (baseline->empty() || baseline->starts_with('-') ||
                                       lower_case(*baseline) == kRandomMachine)) {
    table.complain("baseline",
                   "`baseline` is a text that begins with --nstates, a file with one machine, or "
                   "\"random\", not \"" +
                       *baseline + "\"");
    return;
  }
  std::optional<TurnClock> turn_clock;
  if (!baseline->starts_with("--")) {
    const auto filed = read_filed_machine(table, *baseline, folder);
    if (!filed) return;
    method.baseline = filed->text;
    follow_head(table, filed->head, method);
    turn_clock = filed->head.turn_clock;
  }
  for (const std::string_view key : {"max_states", "max_transitions", "max_subtrees", "behaviours",
                                     "conditions", "parameters", "network"}) {
    if (table.has(key)) {
      table.complain(key,
                     "`" + std::string(key) +
                         "` says what a race may try, and the method's `baseline` is a machine");
    }
  }
  const auto flavour = flavour_of(method);
  if (!flavour) return;  // there is a complaint already
  method.turn_clock = turn_clock.value_or((*flavour)->exploration.turn_clock);
  const auto given = parse_controller(method.baseline, **flavour);
  if (given) {
    method.baseline = print_controller(*given, **flavour);
    method.architecture = architecture_of(*given);
  } else {
    table.complain("baseline", given.error().where + ": " + given.error().message);
  }
}

/// Refuses keys of another architecture than the method's.
void refuse_foreign_keys(TableReader& table, const Method& method) {
  struct Foreign {
    std::string_view key;
    std::vector<Architecture> of;
  };
  static const std::array kKeys = {
      Foreign{"max_states", {Architecture::Machine}},
      Foreign{"max_transitions", {Architecture::Machine}},
      Foreign{"max_subtrees", {Architecture::Tree}},
      Foreign{"behaviours", {Architecture::Machine, Architecture::Tree}},
      Foreign{"conditions", {Architecture::Machine, Architecture::Tree}},
      Foreign{"parameters", {Architecture::Machine, Architecture::Tree}}};
  for (const Foreign& foreign : kKeys) {
    if (!table.has(foreign.key) || std::ranges::count(foreign.of, method.architecture) > 0)
      continue;
    table.take(foreign.key);
    std::string those;
    for (const Architecture architecture : foreign.of)
      those += (those.empty() ? "" : " and ") + std::string(name_of(architecture)) + "s";
    table.complain(foreign.key, "`" + std::string(foreign.key) + "` is for " + those +
                                    ", and this method's architecture is " +
                                    std::string(name_of(method.architecture)));
  }
}

/// External modules are only for programs; the simulator cannot run them.
void refuse_external(TableReader& table, const Flavour& flavour, const Method& method) {
  if (!method.baseline.empty() && method.baseline != kRandomMachine) {
    const auto given = parse_controller(method.baseline, flavour);
    const auto complaint = given ? complaint_about_running(*given, flavour) : std::nullopt;
    if (complaint) table.complain("baseline", *complaint);
    return;
  }
  if (method.architecture == Architecture::Network) return;
  for (const auto& [key, modules] :
       {std::pair("behaviours", &method.behaviours), std::pair("conditions", &method.conditions)}) {
    for (const std::string& id : *modules) {
      const ModuleSpec* spec = flavour.find(id);
      if (spec == nullptr || !is_external(spec->module)) continue;
      table.complain(table.has(key) ? key : "flavour",
                     "`" + id + "` of the flavour " + flavour.name +
                         " is external, which only programs run: leave it out of `" + key +
                         "`, or give [simulator] with kind = \"command\"");
    }
  }
}

/// Reads one [[method]]; `taken` has the names of the methods before it.
Method read_method(TableReader& table, const std::vector<std::string>& taken,
                   const std::filesystem::path& folder, bool has_target) {
  Method method;
  method.name = table.text("name").value_or("");
  if (!check_name(table, method.name, taken)) method.name.clear();
  if (has_parameter_file(table)) {
    if (!has_target) {
      table.complain("parameters",
                     "a parameter file needs programs that evaluate: [simulator] with kind = "
                     "\"command\"");
      table.take_all();
      return method;
    }
    read_search(table, method, true);
    read_parameter_file(table, folder, method);
    return method;
  }
  const Flavour* flavour = read_flavour(table, folder, method);
  if (flavour != nullptr) {
    read_baseline(table, folder, method);
    flavour = *flavour_of(method);
  } else {
    table.take("baseline");
  }
  const bool is_given = !method.baseline.empty() && method.baseline != kRandomMachine;
  const Architecture given = method.architecture;
  read_search(table, method, false);
  if (!is_given) {
    refuse_foreign_keys(table, method);
  } else if (method.architecture != given) {
    if (table.has("architecture")) {
      table.complain("architecture", "`baseline` is a " + std::string(name_of(given)) +
                                         ", and `architecture` says " +
                                         std::string(name_of(method.architecture)));
    }
    method.architecture = given;
  }
  const int most_states = flavour == nullptr ? kMaxStates : flavour->most_states;
  const int most_transitions = flavour == nullptr ? kMaxTransitions : flavour->most_transitions;
  method.max_states = table.integer("max_states", {1, most_states}).value_or(most_states);
  method.max_transitions =
      table.integer("max_transitions", {1, most_transitions}).value_or(most_transitions);
  method.max_subtrees = table.integer("max_subtrees", {1, kMaxSubtrees}).value_or(kMaxSubtrees);
  if (flavour != nullptr) {
    // A given machine's file may set another clock than its flavour.
    if (!is_given || table.has("turn_clock")) method.turn_clock = read_turn_clock(table, *flavour);
    // The default value is allowed, because the text in stores contains it.
    if (table.has("turn_clock") && method.architecture == Architecture::Network &&
        method.turn_clock != flavour->exploration.turn_clock) {
      table.complain("turn_clock",
                     "`turn_clock` is for machines and trees, and this method's architecture is "
                     "network, which has no exploration");
    }
    method.behaviours = read_modules(table, "behaviours", flavour->behaviours, flavour->name);
    method.conditions = read_modules(table, "conditions", flavour->conditions, flavour->name);
    if (auto ranges = table.table("parameters")) read_ranges(*ranges, *flavour, method);
    if (!has_target) refuse_external(table, *flavour, method);
  } else {
    for (const std::string_view key : {"turn_clock", "behaviours", "conditions", "parameters"})
      table.take(key);
  }
  table.finish();
  return method;
}

}  // namespace

std::vector<Method> read_methods(TableReader& root, const std::filesystem::path& folder,
                                 bool has_target) {
  std::vector<Method> methods;
  std::vector<std::string> names;
  for (TableReader& table : root.tables("method")) {
    methods.push_back(read_method(table, names, folder, has_target));
    names.push_back(methods.back().name);
  }
  if (!root.has("method")) {
    root.complain("method",
                  "the file has no [[method]]; the shortest is [[method]] with name = "
                  "\"watermelon\"");
  }
  return methods;
}

}  // namespace swarmsmith
