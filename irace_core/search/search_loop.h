#pragma once

#include <memory>
#include <utility>

#include "base/rng.h"
#include "irace_core/internal/instances.h"
#include "irace_core/internal/kept_configuration.h"
#include "irace_core/scenario.h"
#include "irace_core/search.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith::search {

/// A Search in rounds. It numbers configurations and pairs, counts runs, and reports events; its
/// strategy makes the decisions. As in races, pairs come from the stream "instances" of the
/// scenario's seed.
class SearchLoop final : public Search {
 public:
  /// The strategy may keep a pointer to the space. The errors are those of its first round.
  static Expected<std::unique_ptr<Search>> start(std::unique_ptr<const ParameterSpace> space,
                                                 const Scenario& scenario,
                                                 std::unique_ptr<Strategy> strategy);

  bool finished() const override { return finished_; }
  const std::optional<Error>& failure() const override { return failure_; }
  std::span<const Experiment> wanted() const override { return wanted_; }
  /// Empty: the next round depends on the results of this one.
  std::vector<Experiment> ahead(std::int64_t) const override { return {}; }
  void tell(std::span<const Measurement> measurements) override;
  std::vector<std::int64_t> alive() const override { return alive_; }
  std::vector<RaceEvent> take_events() override { return std::exchange(events_, {}); }
  Expected<void> extend(std::int64_t experiments) override;
  Expected<std::int64_t> least_extension() const override;
  const Configuration& configuration(std::int64_t id) const override;
  const ParameterSpace& space() const override { return *space_; }
  std::span<const Elite> elites() const override { return elites_; }
  std::int64_t experiments_used() const override { return used_; }
  std::int64_t budget() const override { return scenario_.max_experiments; }
  std::int64_t iteration() const override { return iteration_; }
  std::int64_t n_iterations() const override { return strategy_->planned_iterations(); }
  std::int64_t n_alive() const override { return static_cast<std::int64_t>(alive_.size()); }

 private:
  SearchLoop(std::unique_ptr<const ParameterSpace> space, const Scenario& scenario,
             std::unique_ptr<Strategy> strategy);

  /// Asks for the next round, or ends the search.
  Expected<void> ask();
  void begin_iteration(const Round::Start& start);
  /// Reports one step per pair, or one step for all runs.
  void report_steps(std::span<const double> costs);
  void report_step(std::size_t first, std::size_t end, std::span<const double> costs);
  void stop();

  std::unique_ptr<const ParameterSpace> space_;
  Scenario scenario_;
  std::unique_ptr<Strategy> strategy_;
  irace::InstanceLog instances_;
  std::vector<irace::KeptConfiguration> configurations_;  ///< by id - 1
  Round round_;
  std::uint64_t round_digest_ = 0;  ///< of the strategy's state before the round was made
  std::vector<Experiment> wanted_;
  std::vector<std::int64_t> alive_;
  std::vector<Elite> elites_;
  std::vector<RaceEvent> events_;
  std::optional<Error> failure_;
  bool finished_ = false;
  std::int64_t iteration_ = 0;
  std::int64_t steps_ = 0;  ///< steps of the iteration
  std::int64_t used_ = 0;
  std::int64_t pairs_seen_ = 0;
};

}  // namespace swarmsmith::search
