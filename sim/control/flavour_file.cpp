#include "sim/control/flavour_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <variant>

#include "base/assert.h"
#include "base/suggestion.h"
#include "base/text/document.h"
#include "base/text/toml_text.h"
#include "base/text/whole_file.h"
#include "embedded/kChocolateEpuck2018Flavour.h"
#include "embedded/kChocolateEpuckFlavour.h"
#include "embedded/kChocolateFlavour.h"
#include "embedded/kMapleEpuck2018Flavour.h"
#include "embedded/kMapleEpuckFlavour.h"
#include "embedded/kWatermelonArgos3Flavour.h"
#include "embedded/kWatermelonFlavour.h"
#include "sim/control/flavour_text.h"
#include "sim/control/internal/flavour_fields.h"
#include "sim/control/toml_kind.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kFiles = {
    {{"watermelon", kWatermelonFlavour},
     {"watermelon-argos3", kWatermelonArgos3Flavour},
     {"chocolate", kChocolateFlavour},
     {"chocolate-epuck", kChocolateEpuckFlavour},
     {"maple-epuck", kMapleEpuckFlavour},
     {"chocolate-epuck-2018", kChocolateEpuck2018Flavour},
     {"maple-epuck-2018", kMapleEpuck2018Flavour}}};

/// Limits of the numbers of modules and labels in texts.
constexpr Limits<std::int64_t> kNumbers{0, 1000};
constexpr int kMostDigits = 15;  ///< of a real parameter in the search, as in [race]

template <class Value, std::size_t Count>
std::vector<std::string> words_of(const FlavourChoices<Value, Count>& choices) {
  std::vector<std::string> words;
  for (const auto& [word, meaning] : choices)
    words.emplace_back(word);
  return words;
}

std::optional<ColorLabel> label_named(std::string_view name) {
  for (const ColorLabel label :
       {ColorLabel::Green, ColorLabel::Blue, ColorLabel::Red, ColorLabel::Yellow}) {
    if (name_of(label) == name) return label;
  }
  return std::nullopt;
}

/// The visitor that reads the constants from a flavour's table and its subtables. Constants that
/// are missing in the file keep their values.
class ConstantReader {
 public:
  explicit ConstantReader(TableReader& root) : root_(&root) {}

  void table(std::string_view name) {
    finish();
    in_table_ = true;
    if (auto table = root_->table(name)) table_ = std::make_unique<TableReader>(*table);
  }
  /// Must also be called after the visit, since no next table finishes the last one.
  void finish() {
    if (table_) table_->finish();
    table_.reset();
  }

  void number(std::string_view key, double& value, FlavourLimits limits) {
    if (TableReader* table = current())
      value = table->number(key, {limits.least, limits.most}).value_or(value);
  }
  void integer(std::string_view key, int& value, FlavourLimits limits) {
    TableReader* table = current();
    if (table == nullptr) return;
    const Limits<std::int64_t> whole{static_cast<std::int64_t>(limits.least),
                                     static_cast<std::int64_t>(limits.most)};
    value = static_cast<int>(table->integer(key, whole).value_or(value));
  }
  void flag(std::string_view key, bool& value) {
    if (TableReader* table = current()) value = table->boolean(key).value_or(value);
  }
  template <class Value, std::size_t Count>
  void choice(std::string_view key, Value& value, const FlavourChoices<Value, Count>& choices) {
    TableReader* table = current();
    if (table == nullptr) return;
    const auto found = table->choice(key, words_of(choices));
    for (const auto& [word, meaning] : choices) {
      if (found == word) value = meaning;
    }
  }
  void grays(std::string_view key, GrayRange& range) {
    TableReader* table = current();
    const auto pair =
        table == nullptr
            ? std::nullopt
            : table->interval(key, "a range of two grey levels from 0 to 255, such as [0, 25.5]");
    if (!pair) return;
    if (!(0 <= pair->least && pair->least <= pair->most && pair->most <= 255)) {
      table->complain(key, "`" + std::string(key) + "` is from [" + number_text(pair->least) +
                               ", " + number_text(pair->most) +
                               "]; write the lower end first, both from 0 to 255");
      return;
    }
    range = {static_cast<int>(std::lround(pair->least * kGrayThousandths)),
             static_cast<int>(std::lround(pair->most * kGrayThousandths))};
  }
  void labels(std::string_view key, std::vector<LabelSpec>& labels) {
    TableReader* table = current();
    if (table == nullptr || !table->has(key)) return;
    labels.clear();
    static const std::vector<std::string> kNames = {"green", "blue", "red", "yellow"};
    for (TableReader& item : table->tables(key)) {
      const auto name = item.choice("name", kNames);
      if (!item.has("name")) item.complain("name", "a label needs a `name`");
      const auto number = item.integer("number", kNumbers);
      if (!item.has("number")) item.complain("number", "a label needs a `number`");
      const double hue = item.number("hue_deg", {0, 360}).value_or(0);
      const double saturation = item.number("saturation", {0, 1}).value_or(1);
      item.finish();
      if (!name || !number) continue;
      const LabelSpec label{*label_named(*name), static_cast<int>(*number), hue, saturation};
      for (const LabelSpec& other : labels) {
        if (other.label == label.label)
          item.complain("name", "there are two labels `" + *name + "`");
        if (other.number == label.number)
          item.complain("number", "two labels have the number " + std::to_string(label.number));
      }
      labels.push_back(label);
    }
  }

 private:
  TableReader* current() { return in_table_ ? table_.get() : root_; }

  TableReader* root_;
  bool in_table_ = false;
  std::unique_ptr<TableReader> table_;
};

/// The range of a parameter: both ends must be values that a machine may have, with the lower one
/// first.
void read_range(TableReader& table, std::string_view key, ParameterSpec& parameter) {
  const auto range = table.interval(key);
  if (!range) return;
  for (const double bound : {range->least, range->most}) {
    if (const auto complaint = complaint_about(parameter, bound)) {
      table.complain(key, "the range of " + parameter.name + ": " + *complaint + ", this is " +
                              number_text(bound));
      return;
    }
  }
  if (range->least > range->most) {
    table.complain(key, "the range of " + parameter.name + " is [" + number_text(range->least) +
                            ", " + number_text(range->most) + "]: write the lower end first");
    return;
  }
  if (range->least == range->most) {
    table.complain(key, "the range of " + parameter.name +
                            " has only one value, but the search needs several");
    return;
  }
  parameter.low = range->least;
  parameter.high = range->most;
}

bool is_word(std::string_view text) {
  const auto is_letter = [](char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); };
  return !text.empty() && text.size() <= 20 && std::ranges::all_of(text, is_letter);
}

/// The name of a switch, or of a parameter of the search: only letters, because numbers follow
/// them.
void read_word(TableReader& table, std::string_view key, std::string& word) {
  auto text = table.text(key);
  if (!text) return;
  if (is_word(*text)) {
    word = std::move(*text);
  } else {
    table.complain(key, "`" + std::string(key) + "` must be 1 to 20 letters, such as \"att\"");
  }
}

/// Reads token, symbol, range and digits.
void read_details(TableReader& table, ParameterSpec& parameter) {
  read_word(table, "token", parameter.token);
  read_word(table, "symbol", parameter.symbol);
  read_range(table, "range", parameter);
  if (parameter.type == ParameterSpec::Type::Real) {
    parameter.digits =
        static_cast<int>(table.integer("digits", {0, kMostDigits}).value_or(parameter.digits));
  }
}

/// Reads one parameter of a module: its range, or a table with range, token, symbol and digits.
void read_parameter(TableReader& module, ParameterSpec& parameter) {
  const Node* node = module.take(parameter.name);
  if (node == nullptr) return;
  if (parameter.type == ParameterSpec::Type::Label) {
    module.complain(parameter.name, "a label can be any label of the flavour; it has no range");
    return;
  }
  if (!std::holds_alternative<Table>(node->value)) {
    read_range(module, parameter.name, parameter);
    return;
  }
  if (auto table = module.table(parameter.name)) {
    read_details(*table, parameter);
    table->finish();
  }
}

/// Switches that a state, a transition or a subtree has in addition to those of its module.
constexpr std::array<std::string_view, 5> kOwnSwitches = {"s", "n", "c", "a", "nchild"};
/// The success of an action in a tree; conditions have this switch for their beta.
constexpr std::string_view kSwitchOfActions = "p";
/// The same for the parameters of the search.
constexpr std::array<std::string_view, 13> kOwnSymbols = {
    "S",           "N",        "C",        "A",      "NumStates", "NumConnections",
    "NumSubtrees", "Selector", "Children", "Action", "Condition", "Success",
    "Root"};

void check_tokens(TableReader& table, const std::string& id, const ModuleSpec& spec,
                  bool behaviour) {
  std::set<std::string> tokens;
  for (const ParameterSpec& parameter : spec.parameters) {
    if (std::ranges::count(kOwnSwitches, parameter.token) > 0 ||
        (behaviour && parameter.token == kSwitchOfActions)) {
      table.complain(id, "`" + id + "`: --" + parameter.token +
                             " has another meaning in texts; give " + parameter.name +
                             " another token");
    }
    if (std::ranges::count(kOwnSymbols, parameter.symbol) > 0) {
      table.complain(id, "`" + id + "`: the search already has a parameter " + parameter.symbol +
                             "; give " + parameter.name + " another symbol");
    }
    if (!parameter.token.empty() && !tokens.insert(parameter.token).second) {
      table.complain(id, "`" + id + "` has the token `" + parameter.token + "` twice");
    }
  }
}

/// Whether the text can be the name of a module or parameter in stores, tables and campaign files.
bool is_id(std::string_view text) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_";
  return !text.empty() && text.size() <= 60 && 'a' <= text.front() && text.front() <= 'z' &&
         text.find_first_not_of(kLetters) == std::string_view::npos;
}

/// Limit of the parameters of external modules; the program that runs them checks the values.
constexpr double kMostOfExternal = 1e9;

/// Reads one parameter of an external module: name, token, type and range.
ParameterSpec read_external_parameter(TableReader& table) {
  static const std::vector<std::string> kTypes = {"real", "int"};
  ParameterSpec parameter{.least = -kMostOfExternal, .most = kMostOfExternal};
  for (const char* key : {"name", "token", "type", "range"}) {
    if (!table.has(key)) {
      table.complain(key, "a parameter of an external module needs `" + std::string(key) + "`");
    }
  }
  parameter.name = table.text("name").value_or("");
  if (table.has("name") && !is_id(parameter.name))
    table.complain("name", "a parameter's name must consist of small letters, digits and `_`");
  if (table.choice("type", kTypes) == kTypes[1]) {
    parameter.type = ParameterSpec::Type::Integer;
  } else {
    parameter.digits = 2;
  }
  // Read before the details, because the default symbol is the token in capitals.
  read_word(table, "token", parameter.token);
  parameter.symbol = parameter.token;
  for (char& letter : parameter.symbol) {
    if ('a' <= letter && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  }
  read_word(table, "symbol", parameter.symbol);
  read_range(table, "range", parameter);
  if (parameter.type == ParameterSpec::Type::Real) {
    parameter.digits =
        static_cast<int>(table.integer("digits", {0, kMostDigits}).value_or(parameter.digits));
  }
  table.finish();
  return parameter;
}

/// Reads a module that only other programs implement.
void read_external(TableReader& table, bool behaviour, ModuleSpec& spec) {
  spec.module = behaviour ? external_behaviour(spec.number) : external_condition(spec.number);
  for (TableReader& item : table.tables("parameters")) {
    ParameterSpec parameter = read_external_parameter(item);
    if (!parameter.name.empty() &&
        std::ranges::count(spec.parameters, parameter.name, &ParameterSpec::name) > 0)
      item.complain("name", "`" + spec.id + "` has the parameter `" + parameter.name + "` twice");
    spec.parameters.push_back(std::move(parameter));
  }
}

const std::vector<std::string> kExternalKind = {"external"};

/// Reads one line of [behaviours] or [conditions].
std::optional<ModuleSpec> read_module(TableReader& tables, const std::string& id, bool behaviour) {
  auto table = tables.table(id);
  if (!table) return std::nullopt;
  const auto kind = table->choice("kind", kExternalKind);
  if (table->has("kind") && !kind) {
    table->take_all();
    return std::nullopt;
  }
  const auto module = module_from_id(id);
  if (kind && !is_id(id))
    tables.complain(id, "a module's name must consist of small letters, digits and `_`");
  if (kind && module) {
    tables.complain(id, "`" + id +
                            "` is a kind of this program: leave out `kind`, or give "
                            "the external module another name");
  }
  if (!kind && (!module || is_behaviour(*module) != behaviour)) {
    std::vector<std::string> known;
    for (const Module one : all_modules()) {
      if (is_behaviour(one) == behaviour) known.emplace_back(id_of(one));
    }
    tables.complain(id, "there is no kind of " +
                            std::string(behaviour ? "behaviour" : "condition") + " `" + id + "`" +
                            did_you_mean(id, known) + "; kinds are: " + joined(known) +
                            "; for a module of another program write `" + id +
                            " = { kind = \"external\", ... }`");
    table->take_all();
    return std::nullopt;
  }
  ModuleSpec spec{.module = module.value_or(Module::Stop), .id = id, .number = 0, .parameters = {}};
  const auto number = table->integer("number", kNumbers);
  if (!table->has("number"))
    table->complain("number", "`" + id + "` needs a `number`, as in texts of machines");
  spec.number = static_cast<int>(number.value_or(0));
  if (kind) {
    read_external(*table, behaviour, spec);
  } else {
    spec.parameters = parameters_of_kind(spec.module);
    for (ParameterSpec& parameter : spec.parameters)
      read_parameter(*table, parameter);
  }
  table->finish();
  check_tokens(tables, id, spec, behaviour);
  if (!number) return std::nullopt;  // without a number, it cannot be compared with other modules
  return spec;
}

/// Reads the table [behaviours] or [conditions], which replaces the table of the base.
void read_modules(TableReader& root, const std::string& key, std::vector<ModuleSpec>& modules) {
  auto tables = root.table(key);
  if (!tables) return;
  modules.clear();
  for (const auto& [id, node] : tables->take_all()) {
    auto spec = read_module(*tables, id, key == "behaviours");
    if (!spec) continue;
    for (const ModuleSpec& other : modules) {
      if (other.number == spec->number) {
        tables->complain(id, "`" + other.id + "` and `" + id + "` have the same number " +
                                 std::to_string(spec->number));
      }
    }
    modules.push_back(std::move(*spec));
  }
  std::ranges::stable_sort(modules, {}, &ModuleSpec::number);
}

/// The search has one parameter per symbol, so modules with the same symbol must mean the same
/// parameter.
void check_symbols(TableReader& root, const std::string& key,
                   const std::vector<ModuleSpec>& modules) {
  std::map<std::string, std::pair<const ModuleSpec*, const ParameterSpec*>> known;
  for (const ModuleSpec& module : modules) {
    for (const ParameterSpec& parameter : module.parameters) {
      const auto [at, is_new] = known.try_emplace(parameter.symbol, &module, &parameter);
      const ParameterSpec& first = *at->second.second;
      const bool same = first.type == parameter.type && first.token == parameter.token &&
                        first.low == parameter.low && first.high == parameter.high &&
                        first.digits == parameter.digits;
      if (is_new || same) continue;
      root.complain(key, at->second.first->id + " and " + module.id +
                             " have parameters of the symbol " + parameter.symbol +
                             " that differ; give one { symbol = \"...\" }");
    }
  }
}

/// Modules read a reference model, and this program knows only some. Programs that run external
/// modules may have others.
void check_reference(TableReader& root, const Flavour& flavour) {
  const auto runs_elsewhere = [](const ModuleSpec& spec) { return is_external(spec.module); };
  if (std::ranges::any_of(flavour.behaviours, runs_elsewhere) ||
      std::ranges::any_of(flavour.conditions, runs_elsewhere))
    return;
  std::vector<std::string> known = {std::string(kRvrModel)};
  known.insert(known.end(), kStrengthModels.begin(), kStrengthModels.end());
  if (std::ranges::count(known, flavour.reference) > 0) return;
  root.complain("reference", "there is no reference model \"" + flavour.reference + "\"" +
                                 did_you_mean(flavour.reference, known) +
                                 "; known are: " + joined(known));
}

/// Checks the keys of a flavour against each other, after each has been checked alone.
void check_whole(TableReader& root, const Flavour& flavour) {
  for (const auto& [key, modules] : {std::pair("behaviours", &flavour.behaviours),
                                     std::pair("conditions", &flavour.conditions)}) {
    if (modules->empty()) {
      root.complain(key,
                    "a flavour needs a table [" + std::string(key) + "] with at least one entry");
    }
    check_symbols(root, key, *modules);
  }
  for (const ModuleSpec& condition : flavour.conditions) {
    if (std::ranges::count(flavour.behaviours, condition.id, &ModuleSpec::id) > 0)
      root.complain("conditions", "`" + condition.id + "` is also a behaviour");
  }
  if (flavour.find(Module::ColorDetection) != nullptr && flavour.floor.labels.size() != 4) {
    root.complain("floor", "color_detection needs four labels in [floor]");
  }
  check_reference(root, flavour);
  if (flavour.obstacles.near_m >= flavour.obstacles.far_m ||
      flavour.obstacles.neighbour_near_m >= flavour.obstacles.neighbour_far_m) {
    root.complain("obstacles",
                  "`near_m` must be less than `far_m`, and `neighbour_near_m` than "
                  "`neighbour_far_m`");
  }
}

/// Reads the fields of a table; they override the fields of the flavour named by `base`.
void read_fields(TableReader& table, Flavour& flavour) {
  const std::size_t before = table.complaints();
  const std::vector<std::string> names = flavour_names();
  const bool has_constants = table.has("base") || table.has("floor");
  if (const auto base = table.choice("base", names)) {
    std::string name = std::move(flavour.name);
    flavour = *find_flavour(*base).value();
    flavour.name = std::move(name);
  }
  if (auto reference = table.text("reference")) {
    flavour.reference = std::move(*reference);
    if (!is_name(flavour.reference))
      table.complain("reference", "`reference` is the name of a reference model, such as \"rvr\"");
  }
  ConstantReader reader(table);
  visit_flavour_fields(flavour, reader);
  reader.finish();
  read_modules(table, "behaviours", flavour.behaviours);
  read_modules(table, "conditions", flavour.conditions);
  if (table.complaints() == before) check_whole(table, flavour);
  const bool sees_floor = std::ranges::any_of(flavour.conditions, [](const ModuleSpec& spec) {
    return spec.module == Module::BlackFloor || spec.module == Module::GrayFloor ||
           spec.module == Module::WhiteFloor;
  });
  if (!has_constants && sees_floor) {
    table.complain(
        "conditions",
        "conditions of the floor need `black`, `gray` and `white` in a table [floor], or a "
        "`base` that has them");
  }
}

/// A custom flavour must not have the name of a built-in one: a stored "chocolate" must mean the
/// built-in flavour.
bool takes_a_name_of_ours(const Flavour& flavour) {
  return built_in_flavour_text(flavour.name) != "" && !is_built_in(flavour);
}

FlavourOrErrors read_flavour_file(const std::filesystem::path& file) {
  const auto text = read_file(file, "flavour");
  if (!text) return tl::unexpected(std::vector<Error>{text.error()});
  auto flavour = parse_flavour(*text, file);
  if (flavour && takes_a_name_of_ours(*flavour)) {
    const std::string why = "a flavour gets its file's name, but `" + flavour->name +
                            "` is built in with other values; rename the file";
    return tl::unexpected(std::vector<Error>{{ErrorKind::BadInput, why, file.string()}});
  }
  return flavour;
}

/// The flavours embedded in the program, in the order of their files. None of them has a base.
const std::vector<Flavour>& built_in_flavours() {
  static const std::vector<Flavour> kFlavours = [] {
    std::vector<Flavour> flavours;
    for (const auto& [name, text] : kFiles) {
      auto flavour = parse_flavour(text, std::string(name) + ".toml");
      SWARMSMITH_ASSERT(flavour.has_value(), "the flavours that the program carries can be read");
      flavours.push_back(std::move(*flavour));
    }
    return flavours;
  }();
  return kFlavours;
}

}  // namespace

std::vector<std::string> flavour_names() {
  std::vector<std::string> names;
  names.reserve(kFiles.size());
  for (const auto& [name, text] : kFiles)
    names.emplace_back(name);
  return names;
}

std::string_view built_in_flavour_text(std::string_view name) {
  for (const auto& [known, text] : kFiles) {
    if (known == name) return text;
  }
  return {};
}

bool is_built_in(const Flavour& flavour) {
  const auto ours = find_flavour(flavour.name);
  return ours && **ours == flavour;
}

FlavourOrErrors parse_flavour(std::string_view text, const std::filesystem::path& file) {
  const auto document = parse_document(text, file.string());
  if (!document) return tl::unexpected(std::vector<Error>{document.error()});
  Complaints complaints(file.string());
  TableReader root(*document, "", complaints);
  Flavour flavour;
  flavour.name = file.stem().string();
  read_format(root);
  if (!is_name(flavour.name)) {
    root.complain("name",
                  "a flavour gets its file's name, so this must consist of letters, digits, "
                  "`_`, `-` and `.`; it is \"" +
                      flavour.name + "\"");
  }
  read_fields(root, flavour);
  root.finish();
  if (!complaints.empty()) {
    return tl::unexpected(
        complaints_about(*document, TomlKind::Flavour, file.string(), complaints));
  }
  return flavour;
}

FlavourOrErrors find_flavour_file(const std::string& word, const std::filesystem::path& folder) {
  if (names_a_file(word)) return read_flavour_file(folder / word);
  const auto flavour = find_flavour(word);
  if (flavour) return **flavour;
  Error error = flavour.error();
  error.message += "; a file of your own ends in .toml";
  return tl::unexpected(std::vector<Error>{std::move(error)});
}

Flavour read_flavour_table(TableReader& table) {
  Flavour flavour;
  flavour.name = table.text("name").value_or("");
  check_name(table, flavour.name, {});
  read_fields(table, flavour);
  if (takes_a_name_of_ours(flavour)) {
    table.complain("name", "`" + flavour.name +
                               "` is built in with other values; give the flavour "
                               "another name");
  }
  table.finish();
  return flavour;
}

std::vector<const Flavour*> own_flavours_in(std::string_view campaign) {
  std::vector<const Flavour*> flavours;
  if (campaign.find("[method.flavour]") == std::string_view::npos) return flavours;
  const auto document = parse_document(campaign, "campaign");
  if (!document) return flavours;
  Complaints complaints("campaign");
  TableReader root(*document, "", complaints);
  for (TableReader& method : root.tables("method")) {
    const Node* node = method.take("flavour");
    if (node == nullptr || !std::holds_alternative<Table>(node->value)) continue;
    auto table = method.table("flavour");
    Flavour flavour = read_flavour_table(*table);
    if (!complaints.empty()) return flavours;
    if (const Flavour* own = kept_flavour(std::move(flavour))) flavours.push_back(own);
  }
  return flavours;
}

std::string own_flavour_text(const Flavour& flavour) {
  const auto ours = find_flavour(flavour.name, flavour.exploration.turn_clock);
  return ours && *ours == flavour ? "" : flavour_text(flavour);
}

const Flavour& watermelon() {
  return built_in_flavours()[0];
}

const Flavour& watermelon_argos3() {
  return built_in_flavours()[1];
}

const Flavour& chocolate() {
  return built_in_flavours()[2];
}

std::span<const Flavour* const> all_flavours() {
  static const std::vector<const Flavour*> kAll = [] {
    std::vector<const Flavour*> all;
    for (const Flavour& flavour : built_in_flavours())
      all.push_back(&flavour);
    return all;
  }();
  return kAll;
}

}  // namespace swarmsmith
