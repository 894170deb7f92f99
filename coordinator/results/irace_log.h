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
/// makes them of a log, and irace_rdata.R a log of them. Costs are minimised, as in R.

struct LogParameter {
  std::string name;
  char type = 'c';          ///< c, o: texts; i, r: numbers
  std::string switch_text;  ///< put before the value, blank included
  bool log = false;         ///< sampled in the logarithm
  std::string condition;    ///< R's text; empty: always active
  /// The values of c and o; the bounds of i and r, numbers or R's texts. Empty: not known.
  std::vector<std::string> domain;
};

struct LogConfiguration {
  std::int64_t id = 0;
  std::int64_t parent = 0;          ///< 0: none
  std::vector<std::string> values;  ///< by parameter; empty: not active
};

/// An (instance, seed): rows of irace's instance list, and its test instances.
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
  std::optional<double> cost;  ///< infinite or nothing: rejected
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

/// What an instance is called. The tables may have none.
struct LogInstance {
  bool test = false;
  std::int64_t number = 0;  ///< from 1
  std::string name;
};

struct IraceLog {
  std::string version;    ///< of irace
  std::string completed;  ///< why it ended; "Incomplete" when it did not
  std::int64_t seed = 0;
  std::int64_t budget = 0;                  ///< maxExperiments; 0: a time was given
  std::int64_t iterations = 0;              ///< planned
  std::vector<std::int64_t> soft_restarts;  ///< iterations with one
  std::vector<LogParameter> parameters;
  std::vector<LogConfiguration> configurations;  ///< by id
  std::vector<LogPair> pairs;
  std::vector<LogRun> runs;  ///< in the order in which they were made
  std::vector<LogElite> elites;
  std::vector<LogTest> tests;
  std::vector<LogInstance> instances;
  /// Of the scenario, with values in R's words: TRUE, 5, "text"; digits, and forbidden as often as
  /// there are forbidden expressions.
  std::vector<std::pair<std::string, std::string>> options;
  std::string digest;  ///< of the tables' texts
};

/// Names of the tables: "log.csv", "parameters.csv", ...
const std::vector<std::string>& irace_log_files();
/// Those that say what was tuned, and how: a store has no tables for them, and keeps their texts.
const std::vector<std::string>& irace_setting_files();

/// `texts`: by those names; one that is missing is an error, as is a row that names a pair or a
/// configuration that is not there. domains.csv, instances.csv and scenario.csv may be missing.
OrErrors<IraceLog> read_irace_log(const std::map<std::string, std::string>& texts);
/// Only what irace_setting_files hold.
OrErrors<IraceLog> read_irace_settings(const std::map<std::string, std::string>& texts);

/// The reverse: all tables.
std::map<std::string, std::string> print_irace_log(const IraceLog& log);

}  // namespace swarmsmith
