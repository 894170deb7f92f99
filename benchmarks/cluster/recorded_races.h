#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/expected.h"
#include "coordinator/design/work_source.h"

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
/// Looks `ahead` tests ahead within an iteration: each candidate that is alive is offered on the
/// next pairs.
class RecordedRaces final : public WorkSource {
 public:
  RecordedRaces(const std::vector<RecordedRace>& races, int designs, std::size_t ahead = 0);

  std::vector<Task> take_tasks() override { return std::exchange(tasks_, {}); }
  std::vector<Task> take_more(std::size_t count, std::size_t slots) override;
  std::vector<EvaluationKey> take_dropped() override { return std::exchange(dropped_, {}); }
  void tell(const Outcome& outcome) override;
  std::vector<Row> take_rows() override { return std::exchange(rows_, {}); }
  bool finished() const override { return ended_ == designs_.size(); }

  /// Evaluations that the races ask for, all together.
  std::int64_t total() const { return total_; }
  std::int64_t told() const { return told_; }
  std::int64_t tests() const { return tests_; }
  /// Evaluations that a design waits for, by its place.
  std::int64_t awaited(std::size_t number) const { return designs_[number].awaited; }

 private:
  enum class Ahead { Asked, Done, Wanted, Dropped };
  struct Design {
    const RecordedRace* race = nullptr;
    std::vector<std::int64_t> first_pair{};  ///< of each test
    std::size_t next_test = 0;
    std::size_t offered = 0;  ///< tests up to here were asked for, ahead or not
    std::int64_t awaited = 0;
    std::int64_t iteration = 0;
    std::int64_t first_candidate = 0;  ///< of the iteration
    std::int64_t candidates = 0;       ///< so far
    /// Of the iteration's candidates, the one that lives longest first.
    std::vector<std::int64_t> by_rank{};
    std::map<EvaluationKey, Ahead> ahead{};  ///< that were asked for before they were wanted
  };

  void go_on(std::size_t number);
  void begin_iteration(std::size_t number, const RecordedTest& test);
  /// What a test waits for when so many are alive, in canonical order.
  std::vector<Task> tasks_of(std::size_t number, std::size_t test, std::int64_t alive) const;
  void want(std::size_t number, std::size_t test);
  void drop(Design& design, const RecordedTest& test);

  std::vector<Design> designs_;
  std::size_t ahead_;
  std::size_t ended_ = 0;
  std::int64_t total_ = 0;
  std::int64_t told_ = 0;
  std::int64_t tests_ = 0;
  std::vector<Task> tasks_;
  std::vector<EvaluationKey> dropped_;
  std::vector<Row> rows_;
};

}  // namespace swarmsmith::bench
