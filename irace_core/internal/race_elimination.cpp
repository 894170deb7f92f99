#include <algorithm>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/hash.h"
#include "base/ranks.h"
#include "irace_core/internal/means.h"
#include "irace_core/internal/race.h"

namespace swarmsmith::irace {
namespace {

std::vector<std::size_t> united(const std::vector<std::size_t>& a,
                                const std::vector<std::size_t>& b) {
  SWARMSMITH_ASSERT(std::ranges::is_sorted(a) && std::ranges::is_sorted(b),
                    "columns are given in ascending order");
  std::vector<std::size_t> both;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

}  // namespace

void Race::eliminate(RaceStep& step) {
  const bool tests = is_test_point(progress_.task) && alive_.size() > 1;
  const bool caps = is_capping_point();
  if (!tests && !caps) return;
  std::vector<std::size_t> slower;
  if (caps) slower = worse_by_times();
  std::vector<std::size_t> worse;
  if (tests) worse = worse_by_test(step);
  // Capping comes first in irace's loop (rule 9.3.6, before 9.3.7), but both use the same rows,
  // with all alive configurations: neither sees which ones the other dropped. If none passes both,
  // only capping counts (irace facts, 17).
  std::vector<std::size_t> losers = united(worse, slower);
  if (losers.size() == alive_.size()) losers = slower;
  SWARMSMITH_ASSERT(losers.size() < alive_.size(), "the best one is never dropped");
  std::vector<double> ranks;
  if (settings_.test_type != TestType::FTest) ranks = average_ranks(means()).ranks;
  std::vector<std::size_t> dropped;
  for (std::size_t i = 0; i < alive_.size(); ++i) {
    const std::size_t c = alive_[i];
    // A protected elite still has known results on later pairs: dropped now, it would lose to a
    // configuration with runs on fewer pairs than those that made it an elite (rule 9.3.7).
    if (!contains(losers, c) || progress_.protection[c] > 0) continue;
    dropped.push_back(c);
    step.eliminations.push_back(
        {contestants_[c].id, ranks.empty() ? ranks_.rank_sum(c) : ranks[i],
         contains(worse, c) ? EliminationReason::Test : EliminationReason::Capping});
  }
  // 9.3.8.
  step.marker = losers.empty() ? '=' : (dropped.empty() ? '!' : (worse.empty() ? 'c' : '-'));
  if (!dropped.empty()) drop(dropped);
}

std::vector<std::size_t> Race::worse_by_test(RaceStep& step) {
  TestResult result;
  if (settings_.test_type != TestType::FTest) {
    result = t_tests();
  } else if (alive_.size() == 2) {
    result = test_of_two();
  } else {
    result = friedman_test(ranks_, alive_, 1 - settings_.confidence, quantiles_);
  }
  if (!std::isnan(result.p_value)) {
    step.statistic = result.statistic;
    step.p_value = result.p_value;
  }
  return std::move(result.dropped);
}

TestResult Race::test_of_two() {
  SWARMSMITH_ASSERT(alive_.size() == 2, "Wilcoxon's test compares two");
  const PairedResult result =
      wilcoxon_test(costs_so_far(alive_[0]), costs_so_far(alive_[1]), 1 - settings_.confidence);
  TestResult found{result.statistic, result.p_value, {}};
  SWARMSMITH_ASSERT(!(result.drops_first && result.drops_second),
                    "the better one is one of the two");
  if (result.drops_first) found.dropped.push_back(alive_[0]);
  if (result.drops_second) found.dropped.push_back(alive_[1]);
  return found;
}

TestResult Race::t_tests() {
  std::vector<std::span<const double>> costs;
  for (const std::size_t c : alive_)
    costs.push_back(costs_so_far(c));
  return paired_t_tests(costs, means(), alive_, 1 - settings_.confidence, settings_.test_type);
}

std::vector<std::size_t> Race::worse_by_times() const {
  std::vector<std::size_t> elites;
  for (std::size_t i = 0; i < alive_.size(); ++i) {
    if (progress_.protection[alive_[i]] > 0) elites.push_back(i);
  }
  std::vector<std::size_t> found =
      dominated(means(), elites, settings_.capping_type, settings_.min_survival);
  for (std::size_t& c : found)
    c = alive_[c];
  return found;
}

bool Race::is_capping_point() const {
  const auto task = static_cast<std::int64_t>(progress_.task);
  return settings_.capping && static_cast<std::int64_t>(alive_.size()) > settings_.min_survival &&
         task % settings_.block_size == 0 &&
         (!settings_.capping_after_first_test || task >= settings_.first_test);
}

/// The costs have no gap: protected elites have their known results, all others were run on every
/// task.
std::span<const double> Race::costs_so_far(std::size_t column) const {
  SWARMSMITH_ASSERT(costs_[column].size() >= progress_.task,
                    "an alive configuration has a cost for every task");
  return std::span(costs_[column]).first(progress_.task);
}

std::vector<double> Race::means() const {
  std::vector<double> means;
  means.reserve(alive_.size());
  for (const std::size_t c : alive_)
    means.push_back(mean_of(costs_so_far(c)));
  return means;
}

/// Each alive column has a cost here, known or measured: a row ranks all of them.
void Race::add_ranked_row(std::size_t task) {
  std::vector<Entry> row;
  row.reserve(alive_.size());
  for (const std::size_t c : alive_) {
    SWARMSMITH_ASSERT(has_result(c, task), "a row of ranks has no gap");
    row.push_back({costs_[c][task], static_cast<std::uint32_t>(c)});
  }
  quality_.add_row(row);
  ranks_.add_row(std::move(row));
}

void Race::drop(const std::vector<std::size_t>& columns) {
  const std::size_t dropped =
      std::erase_if(alive_, [&](std::size_t c) { return contains(columns, c); });
  SWARMSMITH_ASSERT(dropped == columns.size(), "only alive configurations are dropped");
  std::vector<bool> keeps(contestants_.size(), false);
  for (const std::size_t c : alive_)
    keeps[c] = true;
  ranks_.keep(keeps);
  find_uncovered();
  // Unlike rank sums, standardised rows cannot be reduced to fewer columns, so they are made again.
  quality_.reset();
  std::vector<Entry> row;
  for (std::size_t task = 0; task < static_cast<std::size_t>(ranks_.rows()); ++task) {
    row.clear();
    for (const std::size_t c : alive_) {
      row.push_back({costs_[c][task], static_cast<std::uint32_t>(c)});
    }
    quality_.add_row(row);
  }
}

/// A rejection can remove the only results on past pairs (irace facts, 9.3.2: before a race may
/// stop, an alive configuration must have a result on each of them).
void Race::find_uncovered() {
  uncovered_ = static_cast<std::size_t>(settings_.new_pairs + settings_.past_pairs);
  const auto any_has = [&](std::size_t task) {
    return std::any_of(alive_.begin(), alive_.end(),
                       [&](std::size_t c) { return has_result(c, task); });
  };
  while (uncovered_ > 0 && any_has(uncovered_ - 1))
    --uncovered_;
}

/// irace facts, 9.3.10: the smallest rank (11); of several that are equal, the first.
void Race::describe_best(RaceStep& step) const {
  SWARMSMITH_ASSERT(!alive_.empty() && progress_.task > 0,
                    "a task has ended, and a configuration is alive");
  std::size_t best = 0;
  if (settings_.test_type == TestType::FTest) {
    best = *std::min_element(alive_.begin(), alive_.end(), [&](auto a, auto b) {
      return ranks_.rank_sum(a) < ranks_.rank_sum(b);
    });
  } else {
    const std::vector<double> all = means();
    best = alive_[static_cast<std::size_t>(std::min_element(all.begin(), all.end()) - all.begin())];
  }
  double sum = 0;
  for (const double cost : costs_so_far(best))
    sum += cost;
  step.best = contestants_[best].id;
  step.mean_best = sum / static_cast<double>(progress_.task);
}

void Race::describe_agreement(RaceStep& step) const {
  step.kendall_w = kendall_w(ranks_, alive_);
  step.spearman_rho = spearman_rho(ranks_, alive_);
  step.qvar = quality_.value(alive_);
}

/// Digest of everything that determines the rest of the race. If two replays agree here in each
/// step, the race was given the same costs, as far as they have an effect.
std::uint64_t Race::digest(const RaceStep& step) const {
  Digest digest;
  digest.add(step.task);
  for (const std::size_t c : alive_) {
    digest.add(contestants_[c].id);
    digest.add(ranks_.rank_sum(c));
    // Means depend on more than the ranks.
    if (settings_.test_type != TestType::FTest) digest.add(costs_[c][progress_.task - 1]);
    if (settings_.capping) digest.add(times_[c][progress_.task - 1]);
  }
  digest.add(step.statistic.value_or(-1));
  digest.add(step.p_value.value_or(-1));
  return digest.value64();
}

}  // namespace swarmsmith::irace
