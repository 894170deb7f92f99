#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "base/hash.h"
#include "irace_core/experiment.h"
#include "irace_core/race_event.h"

namespace swarmsmith::testing {

/// Digest of what a search asked for and reported: each field of each experiment and event, but no
/// text. Two searches with the same digest made the same decisions.
class EventDigest {
 public:
  void add(std::int64_t number) { digest_.add(number); }
  void add(double number) { digest_.add(number); }
  void add(bool flag) { digest_.add(std::int64_t{flag}); }
  void add(const std::optional<double>& number) {
    add(number.has_value());
    if (number) add(*number);
  }
  void add(const std::pair<std::int64_t, std::int64_t>& run) { add(run.first), add(run.second); }
  void add(const Elite& e) { add(e.rank), add(e.configuration), add(e.mean), add(e.n); }
  void add(const Elimination& dropped) {
    add(dropped.configuration), add(dropped.rank_sum);
    add(static_cast<std::int64_t>(dropped.reason));
  }
  void add(const Experiment& asked) {
    add(asked.configuration), add(asked.pair), add(asked.instance), add(asked.seed);
    add(asked.bound), add(asked.is_evaluation), add(asked.task);
  }
  template <class Item>
  void add(std::span<const Item> items) {
    add(static_cast<std::int64_t>(items.size()));
    for (const Item& item : items)
      add(item);
  }
  template <class Item>
  void add(const std::vector<Item>& items) {
    add(std::span<const Item>(items));
  }

  void add(const ConfigurationSampled& e) {
    add(e.id), add(e.parent), add(e.iteration);
    digest_.add(e.configuration.digest());
  }
  void add(const IterationStarted& e) {
    add(e.iteration), add(e.n_iterations), add(e.remaining), add(e.budget);
    add(e.n_configurations), add(e.new_pairs), add(e.elites), add(e.soft_restart);
    add(e.postselection);
    digest_.add(e.model_digest);
  }
  void add(const RaceStep& e) {
    add(e.iteration), add(e.task), add(e.pair), add(static_cast<std::int64_t>(e.marker));
    add(e.alive_before), add(e.alive_after), add(e.best), add(e.mean_best);
    add(e.experiments_used), add(e.statistic), add(e.p_value), add(e.kendall_w);
    add(e.spearman_rho), add(e.qvar), add(e.bound), add(e.evaluated), add(e.eliminations);
    digest_.add(e.digest);
  }
  void add(const IterationEnded& e) {
    add(e.iteration), add(e.used), add(e.remaining), add(e.elites);
  }
  void add(const TimeEstimated& e) {
    add(e.runs), add(e.used), add(e.mean_time), add(e.remaining), add(e.bound_max);
    add(e.evaluated);
  }
  void add(const RaceWarning&) {}
  void add(const RaceFinished& e) { add(e.elites); }
  void add(const RaceEvent& event) {
    add(static_cast<std::int64_t>(event.index()));
    std::visit([this](const auto& one) { add(one); }, event);
  }

  std::uint64_t value64() const { return digest_.value64(); }

 private:
  Digest digest_;
};

}  // namespace swarmsmith::testing
