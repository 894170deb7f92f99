#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "base/text/csv.h"

namespace swarmsmith {

/// The log of R's irace (irace.Rdata) as tables, one CSV file each: cli/commands/irace_log.R
/// converts a log to tables, and irace_rdata.R converts tables to a log. Costs are minimised, as in
/// R.

struct LogParameter {
  std::string name;
  char type = 'c';          ///< c, o: values are texts; i, r: numbers
  std::string switch_text;  ///< put before the value; includes the blank
  bool log = false;         ///< sampled on a logarithmic scale
  std::string condition;    ///< an R expression; empty: always active
  /// The values of c and o, or the bounds of i and r, as numbers or R expressions. Empty: unknown.
  std::vector<std::string> domain;
};

struct LogConfiguration {
  std::int64_t id = 0;
  std::int64_t parent = 0;          ///< 0: none
  std::vector<std::string> values;  ///< by parameter; empty: inactive
};

/// A pair (instance, seed): a row of irace's instance list, or a test instance.
struct LogPair {
  bool test = false;
  std::int64_t number = 0;  ///< from 1
  std::int64_t instance = 0;
  std::int64_t seed = 0;  ///< 0: none
};

struct LogRun {
  std::int64_t iteration = 0;
  std::int64_t pair = 0;
  std::int64_t configuration = 0;
  std::optional<double> cost;  ///< infinite or none: rejected
  double time = 0;
  double bound = 0;
};

struct LogElite {
  std::int64_t iteration = 0;
  std::int64_t rank = 0;  ///< from 1
  std::int64_t configuration = 0;
};

struct LogTest {
  std::int64_t pair = 0;
  std::int64_t configuration = 0;
  double cost = 0;
};

/// The name of an instance. The tables may lack names.
struct LogInstance {
  bool test = false;
  std::int64_t number = 0;  ///< from 1
  std::string name;
};

struct IraceLog {
  std::string version;    ///< irace's version
  std::string completed;  ///< why it ended; "Incomplete" if it has not ended
  std::int64_t seed = 0;
  std::int64_t budget = 0;                  ///< maxExperiments; 0: the budget is a time
  std::int64_t iterations = 0;              ///< planned number
  std::vector<std::int64_t> soft_restarts;  ///< iterations in which a soft restart happened
  std::vector<LogParameter> parameters;
  std::vector<LogConfiguration> configurations;  ///< by id
  std::vector<LogPair> pairs;
  std::vector<LogRun> runs;  ///< in the order in which they were run
  std::vector<LogElite> elites;
  std::vector<LogTest> tests;
  std::vector<LogInstance> instances;
  /// The scenario's options, with values in R's notation: TRUE, 5, "text". They also contain
  /// `digits`, and one entry `forbidden` for each forbidden expression.
  std::vector<std::pair<std::string, std::string>> options;
  std::string digest;  ///< of the texts of all tables
};

/// Names of the tables: "log.csv", "parameters.csv", ...
const std::vector<std::string>& irace_log_files();
/// The tables that describe what was tuned and how: a store keeps their texts.
const std::vector<std::string>& irace_setting_files();

/// `texts`: the tables by their file names. A missing table is an error, and so is a row that names
/// a pair or configuration that does not exist. domains.csv, instances.csv and scenario.csv are
/// optional.
OrErrors<IraceLog> read_irace_log(const std::map<std::string, std::string>& texts);
/// Reads only the tables of irace_setting_files.
OrErrors<IraceLog> read_irace_settings(const std::map<std::string, std::string>& texts);

/// The reverse: writes all tables.
std::map<std::string, std::string> print_irace_log(const IraceLog& log);

}  // namespace swarmsmith
