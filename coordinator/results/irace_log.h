#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/results/csv_table.h"

namespace swarmsmith {

/// The log of R's irace (irace.Rdata) as the tables that its converter writes
/// (coordinator/cli/irace_log.R), one CSV file each. Costs are minimised, as in R.

struct LogParameter {
  std::string name;
  char type = 'c';          ///< c, o: texts; i, r: numbers
  std::string switch_text;  ///< put before the value, blank included
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
  std::string digest;  ///< of the tables' texts
};

/// Names of the tables: "log.csv", "parameters.csv", ...
const std::vector<std::string>& irace_log_files();

/// `texts`: by those names; one that is missing is an error, as is a row that names a pair or a
/// configuration that is not there.
OrErrors<IraceLog> read_irace_log(const std::map<std::string, std::string>& texts);

}  // namespace swarmsmith
