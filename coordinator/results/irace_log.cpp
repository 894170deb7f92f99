#include "coordinator/results/irace_log.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/hash.h"
#include "base/text/csv.h"
#include "programs/cost.h"
#include "storage/rows.h"

namespace swarmsmith {
namespace {

/// Older converters did not write these tables.
bool is_optional(const std::string& file) {
  return file == "domains.csv" || file == "instances.csv" || file == "scenario.csv";
}

/// Reads one table by column and collects all errors.
class Reader {
 public:
  Reader(const std::map<std::string, std::string>& texts, const std::string& file,
         std::vector<Error>& errors)
      : errors_(errors) {
    const auto text = texts.find(file);
    if (text == texts.end()) {
      if (!is_optional(file)) {
        errors_.push_back({ErrorKind::BadInput, "the log has no such table", file});
      }
      return;
    }
    auto table = parse_csv(text->second, file);
    if (table) {
      table_ = std::move(*table);
    } else {
      errors_.insert(errors_.end(), table.error().begin(), table.error().end());
    }
  }

  const CsvTable& table() const { return table_; }

  std::string text(const CsvRow& row, const std::string& column) {
    if (!table_.column(column)) complain(row, "there is no column " + column);
    return cell_of(table_, row, column);
  }
  /// The cell of a column that older tables lack.
  std::string text_if_there(const CsvRow& row, const std::string& column) const {
    return cell_of(table_, row, column);
  }
  /// An empty cell (NA) is read as 0.
  std::int64_t integer(const CsvRow& row, const std::string& column) {
    const std::string word = text(row, column);
    if (word.empty()) return 0;
    const auto value = integer_in(word);
    if (!value) complain(row, "column " + column + " must be an integer, not `" + word + "`");
    return value.value_or(0);
  }
  std::optional<double> number(const CsvRow& row, const std::string& column) {
    const std::string word = text(row, column);
    if (word.empty()) return std::nullopt;
    const auto value = number_in(word);
    if (!value) complain(row, "column " + column + " must be a number, not `" + word + "`");
    return value;
  }
  /// An infinite cost means a rejected run.
  std::optional<double> cost(const CsvRow& row) {
    const auto cost = number(row, "cost");
    if (cost && std::isfinite(*cost) && is_too_large(*cost)) {
      complain(row, "the cost " + text(row, "cost") +
                        " is beyond 1e300, where sums of costs are infinite; write Inf for a run "
                        "that was useless");
    }
    return cost;
  }
  /// Refuses ids that a store cannot number.
  void limit(const CsvRow& row, const std::string& what, std::int64_t id, std::int64_t most,
             const std::string& whose) {
    if (id <= most) return;
    complain(row, "the " + what + " " + std::to_string(id) + " is beyond " + std::to_string(most) +
                      ", the most that " + whose);
  }
  void complain(const CsvRow& row, std::string message) {
    errors_.push_back({ErrorKind::BadInput, std::move(message), table_.place(row)});
  }

 private:
  std::vector<Error>& errors_;
  CsvTable table_;
};

void read_head(Reader reader, IraceLog& log) {
  for (const CsvRow& row : reader.table().rows) {
    const std::string key = reader.text(row, "key");
    if (key == "irace_version") log.version = reader.text(row, "value");
    if (key == "completed") log.completed = reader.text(row, "value");
    if (key == "seed") log.seed = reader.integer(row, "value");
    if (key == "max_experiments") log.budget = reader.integer(row, "value");
    if (key == "iterations") log.iterations = reader.integer(row, "value");
    if (key == "soft_restart") log.soft_restarts.push_back(reader.integer(row, "value"));
  }
}

void read_parameters(Reader reader, IraceLog& log) {
  for (const CsvRow& row : reader.table().rows) {
    const std::string type = reader.text(row, "type");
    if (type.size() != 1 || std::string("cori").find(type) == std::string::npos) {
      reader.complain(row, "column type must be c, o, i or r, not `" + type + "`");
      continue;
    }
    log.parameters.push_back({.name = reader.text(row, "name"),
                              .type = type.front(),
                              .switch_text = reader.text(row, "switch"),
                              .log = reader.text_if_there(row, "log") == "1",
                              .condition = reader.text_if_there(row, "condition"),
                              .domain = {}});
  }
}

void read_domains(Reader reader, IraceLog& log) {
  for (const CsvRow& row : reader.table().rows) {
    const auto parameter =
        std::ranges::find(log.parameters, reader.text(row, "parameter"), &LogParameter::name);
    if (parameter == log.parameters.end()) {
      reader.complain(row, "there is no parameter " + reader.text(row, "parameter"));
      continue;
    }
    parameter->domain.push_back(reader.text(row, "value"));
  }
}

void read_instances(Reader reader, IraceLog& log) {
  for (const CsvRow& row : reader.table().rows) {
    log.instances.push_back({.test = reader.text(row, "kind") == "test",
                             .number = reader.integer(row, "instance"),
                             .name = reader.text(row, "name")});
  }
}

void read_options(Reader reader, IraceLog& log) {
  for (const CsvRow& row : reader.table().rows)
    log.options.emplace_back(reader.text(row, "option"), reader.text(row, "value"));
}

void read_configurations(Reader reader, IraceLog& log) {
  // Read by position, because parameters may have any name.
  const std::size_t columns = reader.table().columns.size();
  for (const CsvRow& row : reader.table().rows) {
    if (columns != log.parameters.size() + 2) {
      reader.complain(row, "needs columns id, parent and one for each parameter");
      return;
    }
    const auto id = integer_in(row.cells[0]);
    const auto parent = row.cells[1].empty() ? 0 : integer_in(row.cells[1]);
    const std::int64_t last = log.configurations.empty() ? 0 : log.configurations.back().id;
    if (!id || *id <= last || !parent || *parent < 0 || *parent >= *id) {
      reader.complain(row, "ids count up from 1, and a parent comes before its child");
      continue;
    }
    reader.limit(row, "configuration", *id, kCandidatesPerDesign, "a design can have");
    log.configurations.push_back(
        {*id, *parent, std::vector<std::string>(row.cells.begin() + 2, row.cells.end())});
  }
}

void read_pairs(Reader reader, IraceLog& log) {
  for (const CsvRow& row : reader.table().rows) {
    log.pairs.push_back({.test = reader.text(row, "kind") == "test",
                         .number = reader.integer(row, "pair"),
                         .instance = reader.integer(row, "instance"),
                         .seed = reader.integer(row, "seed")});
    reader.limit(row, "pair", log.pairs.back().number, kPairsPerCandidate - 1,
                 "a candidate can run on");
  }
}

/// The ids to which rows may refer.
struct Known {
  std::set<std::int64_t> configurations;
  std::set<std::int64_t> pairs;
  std::set<std::int64_t> test_pairs;
};

std::int64_t known_id(Reader& reader, const CsvRow& row, const std::string& column,
                      const std::set<std::int64_t>& known) {
  const std::int64_t id = reader.integer(row, column);
  if (!known.contains(id)) {
    reader.complain(row, "there is no " + column + " " + std::to_string(id));
  }
  return id;
}

void read_runs(Reader reader, const Known& known, IraceLog& log) {
  for (const CsvRow& row : reader.table().rows) {
    LogRun run{.iteration = reader.integer(row, "iteration"),
               .pair = known_id(reader, row, "pair", known.pairs),
               .configuration = known_id(reader, row, "configuration", known.configurations),
               .cost = reader.cost(row),
               .time = reader.number(row, "time").value_or(0),
               .bound = reader.number(row, "bound").value_or(0)};
    if (run.iteration < 0) reader.complain(row, "iterations count from 0");
    // Runs that estimate the time precede the first race (irace facts, 16) and count as part of it.
    run.iteration = std::max<std::int64_t>(run.iteration, 1);
    log.runs.push_back(run);
  }
}

void read_elites(Reader reader, const Known& known, IraceLog& log) {
  for (const CsvRow& row : reader.table().rows) {
    log.elites.push_back({reader.integer(row, "iteration"), reader.integer(row, "rank"),
                          known_id(reader, row, "configuration", known.configurations)});
  }
}

void read_tests(Reader reader, const Known& known, IraceLog& log) {
  for (const CsvRow& row : reader.table().rows) {
    const auto cost = reader.cost(row);
    const LogTest test{known_id(reader, row, "pair", known.test_pairs),
                       known_id(reader, row, "configuration", known.configurations),
                       cost.value_or(0)};
    if (cost) log.tests.push_back(test);
  }
}

/// With as many digits as R's converter writes.
std::string long_text(double value) {
  if (std::isinf(value)) return value > 0 ? "Inf" : "-Inf";
  return fmt::format("{:.17g}", value);
}

/// A missing number, stored as 0, becomes an empty cell.
std::string cell(std::int64_t number) {
  return number == 0 ? "" : std::to_string(number);
}
std::string cell(double number) {
  return number == 0 ? "" : long_text(number);
}

using Line = std::vector<std::string>;

std::string print_head(const IraceLog& log) {
  std::string text = csv_line({"key", "value"});
  text += csv_line({"irace_version", log.version});
  text += csv_line({"completed", log.completed});
  text += csv_line({"seed", cell(log.seed)});
  text += csv_line({"max_experiments", std::to_string(log.budget)});
  text += csv_line({"iterations", std::to_string(log.iterations)});
  for (const std::int64_t iteration : log.soft_restarts)
    text += csv_line({"soft_restart", std::to_string(iteration)});
  return text;
}

std::string print_parameters(const IraceLog& log) {
  std::string text = csv_line({"name", "type", "switch", "log", "condition"});
  for (const LogParameter& parameter : log.parameters) {
    text += csv_line({parameter.name, std::string(1, parameter.type), parameter.switch_text,
                      parameter.log ? "1" : "0", parameter.condition});
  }
  return text;
}

std::string print_domains(const IraceLog& log) {
  std::string text = csv_line({"parameter", "value"});
  for (const LogParameter& parameter : log.parameters)
    for (const std::string& value : parameter.domain)
      text += csv_line({parameter.name, value});
  return text;
}

std::string print_configurations(const IraceLog& log) {
  Line columns{"id", "parent"};
  for (const LogParameter& parameter : log.parameters)
    columns.push_back(parameter.name);
  std::string text = csv_line(columns);
  for (const LogConfiguration& configuration : log.configurations) {
    Line line{std::to_string(configuration.id), cell(configuration.parent)};
    line.insert(line.end(), configuration.values.begin(), configuration.values.end());
    text += csv_line(line);
  }
  return text;
}

std::string print_pairs(const IraceLog& log) {
  std::string text = csv_line({"kind", "pair", "instance", "seed"});
  for (const LogPair& pair : log.pairs) {
    text += csv_line({pair.test ? "test" : "race", std::to_string(pair.number),
                      std::to_string(pair.instance), cell(pair.seed)});
  }
  return text;
}

std::string print_runs(const IraceLog& log) {
  std::string text = csv_line({"iteration", "pair", "configuration", "cost", "time", "bound"});
  for (const LogRun& run : log.runs) {
    text += csv_line({std::to_string(run.iteration), std::to_string(run.pair),
                      std::to_string(run.configuration), run.cost ? long_text(*run.cost) : "",
                      cell(run.time), cell(run.bound)});
  }
  return text;
}

std::string print_elites(const IraceLog& log) {
  std::string text = csv_line({"iteration", "rank", "configuration"});
  for (const LogElite& elite : log.elites) {
    text += csv_line({std::to_string(elite.iteration), std::to_string(elite.rank),
                      std::to_string(elite.configuration)});
  }
  return text;
}

std::string print_tests(const IraceLog& log) {
  std::string text = csv_line({"pair", "configuration", "cost"});
  for (const LogTest& test : log.tests) {
    text += csv_line(
        {std::to_string(test.pair), std::to_string(test.configuration), long_text(test.cost)});
  }
  return text;
}

std::string print_instances(const IraceLog& log) {
  std::string text = csv_line({"kind", "instance", "name"});
  for (const LogInstance& instance : log.instances) {
    text +=
        csv_line({instance.test ? "test" : "race", std::to_string(instance.number), instance.name});
  }
  return text;
}

std::string print_options(const IraceLog& log) {
  std::string text = csv_line({"option", "value"});
  for (const auto& [option, value] : log.options)
    text += csv_line({option, value});
  return text;
}

}  // namespace

const std::vector<std::string>& irace_log_files() {
  static const std::vector<std::string> kFiles{
      "log.csv",  "parameters.csv", "domains.csv", "configurations.csv", "pairs.csv",
      "runs.csv", "elites.csv",     "tests.csv",   "instances.csv",      "scenario.csv"};
  return kFiles;
}

const std::vector<std::string>& irace_setting_files() {
  static const std::vector<std::string> kFiles{"parameters.csv", "domains.csv", "instances.csv",
                                               "scenario.csv"};
  return kFiles;
}

OrErrors<IraceLog> read_irace_settings(const std::map<std::string, std::string>& texts) {
  IraceLog log;
  std::vector<Error> errors;
  read_parameters(Reader(texts, "parameters.csv", errors), log);
  read_domains(Reader(texts, "domains.csv", errors), log);
  read_instances(Reader(texts, "instances.csv", errors), log);
  read_options(Reader(texts, "scenario.csv", errors), log);
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  return log;
}

OrErrors<IraceLog> read_irace_log(const std::map<std::string, std::string>& texts) {
  IraceLog log;
  std::vector<Error> errors;
  const auto table = [&](const char* file) { return Reader(texts, file, errors); };
  read_head(table("log.csv"), log);
  read_parameters(table("parameters.csv"), log);
  read_domains(table("domains.csv"), log);
  read_configurations(table("configurations.csv"), log);
  read_pairs(table("pairs.csv"), log);
  Known known;
  for (const LogConfiguration& configuration : log.configurations)
    known.configurations.insert(configuration.id);
  for (const LogPair& pair : log.pairs)
    (pair.test ? known.test_pairs : known.pairs).insert(pair.number);
  read_runs(table("runs.csv"), known, log);
  read_elites(table("elites.csv"), known, log);
  read_tests(table("tests.csv"), known, log);
  read_instances(table("instances.csv"), log);
  read_options(table("scenario.csv"), log);
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  Digest digest;
  for (const std::string& file : irace_log_files())
    if (const auto text = texts.find(file); text != texts.end()) digest.add(text->second);
  log.digest = digest.hex();
  return log;
}

std::map<std::string, std::string> print_irace_log(const IraceLog& log) {
  return {{"log.csv", print_head(log)},
          {"parameters.csv", print_parameters(log)},
          {"domains.csv", print_domains(log)},
          {"configurations.csv", print_configurations(log)},
          {"pairs.csv", print_pairs(log)},
          {"runs.csv", print_runs(log)},
          {"elites.csv", print_elites(log)},
          {"tests.csv", print_tests(log)},
          {"instances.csv", print_instances(log)},
          {"scenario.csv", print_options(log)}};
}

}  // namespace swarmsmith
