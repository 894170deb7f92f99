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

/// What came of a run, as its store has it.
struct IraceResult {
  struct Best {
    std::int64_t number = 0;  ///< irace's id
    double mean = 0;          ///< cost
    std::int64_t pairs = 0;   ///< that the mean is over
  };

  CandidateTable candidates;
  std::vector<Best> best;  ///< best first
  DesignStateRow state;
  /// Test instance and its seed.
  std::map<std::int64_t, std::int64_t> test_seeds;
  /// Cost by configuration and test instance; infinite for a rejection.
  std::map<std::pair<std::int64_t, std::int64_t>, double> tests;
};

/// Reads it. Corrupt, when the store holds what cannot be read.
Expected<IraceResult> read_irace_result(StoreReader& store, const ParameterSpace& space);

/// irace's blocks at the end: best configurations as a table and as command lines. The second one
/// is read by people's scripts (irace facts, 24).
std::string best_text(const IraceResult& result, const Scenario& scenario);
/// Costs of the test instances, a column a configuration; empty without any. `date` is theirs.
std::string testing_text(const IraceResult& result, const std::string& date);
/// When the last campaign of a store ended, as irace's lines have dates.
std::string end_date(StoreReader& store);
/// A command found its results in a store, and has run nothing.
std::string nothing_ran_text(const std::string& date, const std::filesystem::path& store);
/// The event {"v":1,"event":"done",...}, docs/command-line.md.
std::string result_json(const IraceResult& result, const std::string& store, std::int64_t seed);

}  // namespace swarmsmith::cli
