#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "coordinator/work_source.h"

namespace swarmsmith::bench {

/// A test of a race, and the evaluations that it waits for.
struct RecordedTest {
  std::int64_t iteration = 0;
  std::int64_t alive = 0;      ///< before it
  std::int64_t kept = 0;       ///< after it
  std::int64_t evaluated = 0;  ///< since the test before; elites have been on older pairs already
};
using RecordedRace = std::vector<RecordedTest>;

/// The races of benchmarks/data/races.csv, see benchmarks/record_races.
Expected<std::vector<RecordedRace>> read_races(const std::filesystem::path& file);

/// Designs whose races go as recorded ones did: as many evaluations before each test, as many
/// survivors. Who survives is drawn from a fixed stream. Design n takes the recorded races in turn.
class RecordedRaces final : public WorkSource {
 public:
  RecordedRaces(const std::vector<RecordedRace>& races, int designs, int open_at_once);

  std::vector<Task> take_tasks() override { return std::exchange(tasks_, {}); }
  void tell(const Outcome& outcome) override;
  std::vector<Row> take_rows() override { return std::exchange(rows_, {}); }
  bool finished() const override { return ended_ == designs_.size(); }

  /// Evaluations that the races ask for, all together.
  std::int64_t total() const { return total_; }
  std::int64_t told() const { return told_; }

 private:
  struct Design {
    const RecordedRace* race = nullptr;
    std::size_t next_test = 0;
    std::int64_t awaited = 0;
    std::int64_t iteration = 0;
    std::int64_t first_candidate = 0;  ///< of the iteration
    std::int64_t candidates = 0;       ///< so far
    std::int64_t pairs = 0;            ///< so far
    /// Of the iteration's candidates, the one that lives longest first.
    std::vector<std::int64_t> by_rank{};
  };

  void open();
  void go_on(std::size_t number);
  void begin_iteration(std::size_t number, const RecordedTest& test);
  void want(std::size_t number, const RecordedTest& test);

  std::vector<Design> designs_;
  std::size_t opened_ = 0;
  std::size_t ended_ = 0;
  std::size_t open_at_once_;
  std::int64_t total_ = 0;
  std::int64_t told_ = 0;
  std::vector<Task> tasks_;
  std::vector<Row> rows_;
};

}  // namespace swarmsmith::bench
