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
  std::int64_t alive = 0;      ///< before the test
  std::int64_t kept = 0;       ///< after the test
  std::int64_t evaluated = 0;  ///< since the previous test; elites have already been on older pairs
};
using RecordedRace = std::vector<RecordedTest>;

/// The races of benchmarks/data/races.csv, see benchmarks/record_races.
Expected<std::vector<RecordedRace>> read_races(const std::filesystem::path& file);

/// Designs whose races proceed like recorded ones: with the same number of evaluations before each
/// test, and the same number of survivors. Random numbers from a fixed stream decide which
/// candidates survive. The designs take the recorded races in turn. Looks `ahead` tests ahead
/// within an iteration: each candidate that is alive is offered on the next pairs.
class RecordedRaces final : public WorkSource {
 public:
  RecordedRaces(const std::vector<RecordedRace>& races, int designs, std::size_t ahead = 0);

  std::vector<Task> take_tasks() override { return std::exchange(tasks_, {}); }
  std::vector<Task> take_more(std::size_t count, std::size_t slots) override;
  std::vector<EvaluationKey> take_dropped() override { return std::exchange(dropped_, {}); }
  void tell(const Outcome& outcome) override;
  std::vector<Row> take_rows() override { return std::exchange(rows_, {}); }
  bool finished() const override { return ended_ == designs_.size(); }

  /// Total number of evaluations that the races request.
  std::int64_t total() const { return total_; }
  std::int64_t told() const { return told_; }
  std::int64_t tests() const { return tests_; }
  /// Number of evaluations that a design waits for; `number` is its index.
  std::int64_t awaited(std::size_t number) const { return designs_[number].awaited; }

 private:
  enum class Ahead { Asked, Done, Wanted, Dropped };
  struct Design {
    const RecordedRace* race = nullptr;
    std::vector<std::int64_t> first_pair{};  ///< of each test
    std::size_t next_test = 0;
    std::size_t offered = 0;  ///< tests up to this one were requested, ahead or not
    std::int64_t awaited = 0;
    std::int64_t iteration = 0;
    std::int64_t first_candidate = 0;  ///< of the iteration
    std::int64_t candidates = 0;       ///< so far
    /// The iteration's candidates, beginning with the one that stays alive longest.
    std::vector<std::int64_t> by_rank{};
    std::map<EvaluationKey, Ahead> ahead{};  ///< requested before a test needed them
  };

  void go_on(std::size_t number);
  void begin_iteration(std::size_t number, const RecordedTest& test);
  /// The evaluations that a test with this many alive candidates needs, in canonical order.
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
