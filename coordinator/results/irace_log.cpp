#include "coordinator/results/irace_log.h"

#include <algorithm>
#include <set>
#include <utility>

#include "base/hash.h"

namespace swarmsmith {
namespace {

/// One table, whose cells are read by column; what is wrong is gathered.
class Reader {
 public:
  Reader(const std::map<std::string, std::string>& texts, const std::string& file,
         std::vector<Error>& errors)
      : errors_(errors) {
    const auto text = texts.find(file);
    if (text == texts.end()) {
      errors_.push_back({ErrorKind::BadInput, "the log has no such table", file});
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
  /// NA, which is an empty cell, is 0.
  std::int64_t integer(const CsvRow& row, const std::string& column) {
    const std::string word = text(row, column);
    if (word.empty()) return 0;
    const auto value = integer_in(word);
    if (!value) complain(row, "column " + column + " wants an integer, not `" + word + "`");
    return value.value_or(0);
  }
  std::optional<double> number(const CsvRow& row, const std::string& column) {
    const std::string word = text(row, column);
    if (word.empty()) return std::nullopt;
    const auto value = number_in(word);
    if (!value) complain(row, "column " + column + " wants a number, not `" + word + "`");
    return value;
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
      reader.complain(row, "column type wants c, o, i or r, not `" + type + "`");
      continue;
    }
    log.parameters.push_back({reader.text(row, "name"), type.front(), reader.text(row, "switch")});
  }
}

void read_configurations(Reader reader, IraceLog& log) {
  // A parameter may be called as it likes: by position.
  const std::size_t columns = reader.table().columns.size();
  for (const CsvRow& row : reader.table().rows) {
    if (columns != log.parameters.size() + 2) {
      reader.complain(row, "wants id, parent and a column for each parameter");
      return;
    }
    const auto id = integer_in(row.cells[0]);
    const auto parent = row.cells[1].empty() ? 0 : integer_in(row.cells[1]);
    const std::int64_t last = log.configurations.empty() ? 0 : log.configurations.back().id;
    if (!id || *id <= last || !parent || *parent < 0 || *parent >= *id) {
      reader.complain(row, "ids count up from 1, and a parent comes before its child");
      continue;
    }
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
  }
}

/// What rows may refer to.
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
               .cost = reader.number(row, "cost"),
               .time = reader.number(row, "time").value_or(0),
               .bound = reader.number(row, "bound").value_or(0)};
    if (run.iteration < 1) reader.complain(row, "iterations count from 1");
    log.runs.push_back(std::move(run));
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
    const auto cost = reader.number(row, "cost");
    const LogTest test{known_id(reader, row, "pair", known.test_pairs),
                       known_id(reader, row, "configuration", known.configurations),
                       cost.value_or(0)};
    if (cost) log.tests.push_back(test);
  }
}

}  // namespace

const std::vector<std::string>& irace_log_files() {
  static const std::vector<std::string> kFiles{"log.csv",   "parameters.csv", "configurations.csv",
                                               "pairs.csv", "runs.csv",       "elites.csv",
                                               "tests.csv"};
  return kFiles;
}

OrErrors<IraceLog> read_irace_log(const std::map<std::string, std::string>& texts) {
  IraceLog log;
  std::vector<Error> errors;
  const auto table = [&](const char* file) { return Reader(texts, file, errors); };
  read_head(table("log.csv"), log);
  read_parameters(table("parameters.csv"), log);
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
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  Digest digest;
  for (const std::string& file : irace_log_files())
    digest.add(texts.at(file));
  log.digest = digest.hex();
  return log;
}

}  // namespace swarmsmith
