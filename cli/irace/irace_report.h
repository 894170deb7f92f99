#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "cli/irace/candidate_table.h"
#include "irace_core/scenario.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The result of a run, from its store.
struct IraceResult {
  struct Best {
    std::int64_t number = 0;  ///< irace's id
    double mean = 0;          ///< cost
    std::int64_t pairs = 0;   ///< the number of pairs in the mean
  };

  CandidateTable candidates;
  std::vector<Best> best;  ///< best first
  DesignStateRow state;
  /// The seed of each test instance.
  std::map<std::int64_t, std::int64_t> test_seeds;
  /// Cost by configuration and test instance; infinite for a rejection.
  std::map<std::pair<std::int64_t, std::int64_t>, double> tests;
};

/// Reads the result. Corrupt if the store holds something that cannot be read.
Expected<IraceResult> read_irace_result(StoreReader& store, const ParameterSpace& space);

/// irace's blocks at the end: the best configurations as a table and as command lines. Users'
/// scripts read the command lines (irace facts, 24).
std::string best_text(const IraceResult& result, const Scenario& scenario);
/// The costs on the test instances, one column per configuration; empty if there are none. `date`
/// is the date of the lines.
std::string testing_text(const IraceResult& result, const std::string& date);
/// When the last campaign of a store ended, in the date format of irace's lines.
std::string end_date(StoreReader& store);
/// The text for a command that found its results in a store and ran nothing.
std::string nothing_ran_text(const std::string& date, const std::filesystem::path& store);
/// The event {"v":1,"event":"done",...}, docs/command-line.md.
std::string result_json(const IraceResult& result, const std::string& store, std::int64_t seed);

}  // namespace swarmsmith::cli
