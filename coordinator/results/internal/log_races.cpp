#include "coordinator/results/internal/log_races.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace swarmsmith {

bool is_rejected(const LogRun& run) {
  return !run.cost || !std::isfinite(*run.cost);
}

LogRaces::LogRaces(const IraceLog& log) : log_(log) {
  for (const LogRun& run : log_.runs) {
    iterations_ = std::max(iterations_, run.iteration);
    if (!is_rejected(run)) {
      scores_.emplace(std::pair{run.configuration, run.pair}, std::pair{run.iteration, -*run.cost});
    }
  }
  for (const LogElite& elite : log_.elites)
    elites_[elite.iteration].push_back(elite.configuration);
}

std::optional<double> LogRaces::score(std::int64_t configuration, std::int64_t pair,
                                      std::int64_t iteration) const {
  const auto found = scores_.find({configuration, pair});
  // A later race may run a configuration on a pair that it did not reach before, as post-selection
  // does with those that a test dropped.
  if (found == scores_.end() || found->second.first > iteration) return std::nullopt;
  return found->second.second;
}

LogRaces::Configurations LogRaces::elites_of(std::int64_t iteration) const {
  const auto found = elites_.find(iteration);
  return found == elites_.end() ? Configurations{} : found->second;
}

LogRaces::Configurations LogRaces::racers_of(std::int64_t iteration) const {
  const Configurations kept = elites_of(iteration - 1);
  std::set<std::int64_t> racers(kept.begin(), kept.end());
  for (const LogRun& run : log_.runs)
    if (run.iteration == iteration) racers.insert(run.configuration);
  return {racers.begin(), racers.end()};
}

std::vector<LogStep> LogRaces::steps_of(std::int64_t iteration) const {
  std::vector<LogStep> steps;
  const Configurations racers = racers_of(iteration);
  std::set<std::pair<std::int64_t, std::int64_t>> ran;
  for (const LogRun& run : log_.runs) {
    if (run.iteration != iteration) continue;
    const auto known = std::ranges::find(steps, run.pair, &LogStep::pair);
    LogStep& step =
        known == steps.end() ? steps.emplace_back(LogStep{iteration, run.pair, 0, {}}) : *known;
    ++step.evaluated;
    ran.emplace(run.configuration, run.pair);
  }
  for (LogStep& step : steps) {
    for (const std::int64_t racer : racers) {
      // An elite does not run again on pairs of earlier iterations: it has a score there, but no
      // run in this iteration. A rejected run is a run without a score.
      if (ran.contains({racer, step.pair}) || score(racer, step.pair, iteration))
        step.alive.push_back(racer);
    }
  }
  return steps;
}

std::pair<std::int64_t, double> LogRaces::best_of(const std::vector<LogStep>& steps,
                                                  std::size_t at) const {
  std::pair<std::int64_t, double> best{0, 0};
  for (const std::int64_t configuration : steps[at].alive) {
    double sum = 0;
    bool whole = true;
    for (std::size_t i = 0; i <= at && whole; ++i) {
      const auto value = score(configuration, steps[i].pair, steps[i].iteration);
      whole = value.has_value();
      sum += value.value_or(0);
    }
    const double mean = sum / static_cast<double>(at + 1);
    if (whole && (best.first == 0 || mean > best.second)) best = {configuration, mean};
  }
  return best;
}

double LogRaces::rank_sum(const std::vector<LogStep>& steps, std::size_t at,
                          std::int64_t configuration) const {
  double sum = 0;
  for (std::size_t i = 0; i <= at; ++i) {
    const auto own = score(configuration, steps[i].pair, steps[i].iteration);
    double better = 0;
    double equal = 0;
    for (const std::int64_t other : steps[at].alive) {
      const auto value = score(other, steps[i].pair, steps[i].iteration);
      // Without a score is the worst rank, which all such configurations share.
      if (value == own) {
        ++equal;
      } else if (value && (!own || *value > *own)) {
        ++better;
      }
    }
    // `equal` counts the configuration itself: alone, its rank is better + 1.
    sum += better + (equal + 1) / 2;
  }
  return sum;
}

}  // namespace swarmsmith
