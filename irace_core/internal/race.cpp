#include "irace_core/internal/race.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "base/hash.h"
#include "irace_core/internal/ranking.h"

namespace swarmsmith::irace {
namespace {

constexpr double kNoResult = std::numeric_limits<double>::quiet_NaN();

bool contains(std::span<const std::size_t> sorted, std::size_t column) {
  return std::binary_search(sorted.begin(), sorted.end(), column);
}

/// Why a rule ended the race, with both sides of its comparison.
std::string compared(const char* what, std::int64_t left, const char* sign, const char* other,
                     std::int64_t right) {
  return std::string(what) + " (" + std::to_string(left) + ") " + sign + " " + other + " (" +
         std::to_string(right) + ")";
}

}  // namespace

Race::Race(RaceSettings settings, std::vector<Contestant> contestants)
    : settings_(std::move(settings)),
      contestants_(std::move(contestants)),
      costs_(contestants_.size()),
      rejected_(contestants_.size(), false),
      ranks_(contestants_.size()),
      quality_(contestants_.size()),
      quantiles_((1 - settings_.confidence) / 2) {
  const auto new_pairs = static_cast<std::size_t>(settings_.new_pairs);
  for (std::size_t c = 0; c < contestants_.size(); ++c) {
    const std::vector<double>& past = contestants_[c].past;
    alive_.push_back(c);
    if (!past.empty()) {
      costs_[c].assign(new_pairs, kNoResult);
      costs_[c].insert(costs_[c].end(), past.begin(), past.end());
    }
    const auto known = std::count_if(past.begin(), past.end(), [](double x) { return x == x; });
    progress_.protection.push_back(known);
    progress_.results.push_back(known);
  }
  find_uncovered();
  tell(std::span<const Measurement>{});
}

bool Race::has_result(std::size_t column, std::size_t task) const {
  return task < costs_[column].size() && !std::isnan(costs_[column][task]);
}

bool Race::anybody_protected(const Progress& progress) const {
  return std::any_of(alive_.begin(), alive_.end(),
                     [&](std::size_t c) { return progress.protection[c] > 0; });
}

std::vector<std::size_t> Race::to_run(const Progress& progress) const {
  std::vector<std::size_t> columns;
  for (const std::size_t c : alive_) {
    if (!has_result(c, progress.task)) columns.push_back(c);
  }
  return columns;
}

/// The canonical order within a task; that of the columns has the elites by rank.
std::vector<std::size_t> Race::by_id(std::span<const std::size_t> columns) const {
  std::vector<std::size_t> sorted(columns.begin(), columns.end());
  std::sort(sorted.begin(), sorted.end(),
            [&](std::size_t a, std::size_t b) { return contestants_[a].id < contestants_[b].id; });
  return sorted;
}

bool Race::is_test_point(std::size_t task) const {
  const auto t = static_cast<std::int64_t>(task);
  return t >= settings_.first_test && t % settings_.pairs_between_tests == 0;
}

/// The last pair that the elites brought along, or that comes first as a new one, must have been
/// seen by somebody alive, and everybody must have seen whole steps between tests.
bool Race::elites_are_done(const Progress& progress) const {
  if (settings_.past_pairs == 0) return true;  // the first race
  if (progress.task < uncovered_) return false;
  return std::all_of(alive_.begin(), alive_.end(), [&](std::size_t c) {
    return progress.results[c] % settings_.pairs_between_tests == 0;
  });
}

std::optional<std::string> Race::reason_to_stop(const Progress& progress, std::size_t runs) const {
  if (!elites_are_done(progress)) return std::nullopt;
  const auto alive = static_cast<std::int64_t>(alive_.size());
  if (alive <= settings_.min_survival) {
    return compared("configurations alive", alive, "<=", "those that survive",
                    settings_.min_survival);
  }
  const auto done = static_cast<std::int64_t>(progress.task);
  const std::int64_t next_test =
      progress.used + static_cast<std::int64_t>(runs) * settings_.pairs_between_tests;
  if (done >= settings_.first_test && done % settings_.pairs_between_tests == 0 &&
      next_test > settings_.max_experiments) {
    return compared("experiments up to the next test", next_test, ">", "budget of the race",
                    settings_.max_experiments);
  }
  if (settings_.elitist_limit > 0 && tests_without_drop_ >= settings_.elitist_limit) {
    return compared("tests without elimination", tests_without_drop_, ">=", "limit",
                    settings_.elitist_limit);
  }
  return std::nullopt;
}

/// Counts a task on which `ran` were run; protected ones that were not have used up a known pair.
void Race::pass(Progress& progress, std::span<const std::size_t> ran) const {
  for (const std::size_t c : alive_) {
    if (contains(ran, c)) {
      ++progress.results[c];
    } else if (progress.protection[c] > 0) {
      --progress.protection[c];
    }
  }
  progress.used += static_cast<std::int64_t>(ran.size());
  ++progress.task;
}

/// Asks for all runs up to the next test, supposing that none of them is a rejection.
void Race::plan() {
  Progress ahead = progress_;
  while (ahead.task < settings_.pairs.size()) {
    const std::vector<std::size_t> columns = to_run(ahead);
    if (!columns.empty() && reason_to_stop(ahead, columns.size())) return;
    for (const std::size_t c : by_id(columns))
      wanted_.push_back({ahead.task, c});
    pass(ahead, columns);
    if (!columns.empty() && is_test_point(ahead.task)) return;
  }
}

void Race::tell(std::span<const Measurement> measurements) {
  SWARMSMITH_ASSERT(measurements.size() == wanted_.size(), "one cost for every wanted run");
  std::size_t at = 0;
  while (!stop_) {
    if (progress_.task == settings_.pairs.size()) {
      stop_ = "no pairs left";
      break;
    }
    const std::vector<std::size_t> columns = to_run(progress_);
    if (!columns.empty()) {
      stop_ = reason_to_stop(progress_, columns.size());
      if (stop_ || at == wanted_.size()) break;
    }
    // Runs of those that were rejected on an earlier task are void.
    for (; at < wanted_.size() && wanted_[at].task == progress_.task; ++at) {
      const std::size_t c = wanted_[at].column;
      if (rejected_[c]) continue;
      costs_[c].resize(std::max(costs_[c].size(), progress_.task + 1), kNoResult);
      costs_[c][progress_.task] = measurements[at].cost;
    }
    do_task(columns, steps_.emplace_back());
  }
  wanted_.clear();
  if (!stop_) plan();
}

void Race::do_task(std::span<const std::size_t> ran, RaceStep& step) {
  const std::size_t task = progress_.task;
  step.task = static_cast<std::int64_t>(task) + 1;
  step.pair = settings_.pairs[task];
  step.alive_before = static_cast<std::int64_t>(alive_.size());
  for (const std::size_t c : by_id(ran))
    step.evaluated.push_back(contestants_[c].id);
  pass(progress_, ran);
  used_ = progress_.used;
  step.experiments_used = used_;
  if (reject_infinite(ran, step) && alive_.empty()) {
    stop_ = "all configurations were rejected";
    return;
  }
  add_ranked_row(task);
  describe_best(step);
  if (ran.empty()) {
    step.marker = '.';
  } else if (is_test_point(progress_.task) && alive_.size() > 1) {
    run_test(step);
  }
  const bool counts = !ran.empty() && !anybody_protected(progress_) &&
                      step.task > settings_.first_test && is_test_point(progress_.task);
  if (counts) tests_without_drop_ = step.marker == '-' ? 0 : tests_without_drop_ + 1;
  step.alive_after = static_cast<std::int64_t>(alive_.size());
  describe_agreement(step);
  step.digest = digest(step);
}

bool Race::reject_infinite(std::span<const std::size_t> ran, RaceStep& step) {
  std::vector<std::size_t> columns;
  for (const std::size_t c : ran) {
    if (!std::isinf(costs_[c][progress_.task - 1])) continue;
    columns.push_back(c);
    rejected_[c] = true;
    costs_[c].clear();
    step.eliminations.push_back({contestants_[c].id, 0, EliminationReason::Rejection});
  }
  if (columns.empty()) return false;
  drop(columns);
  return true;
}

void Race::add_ranked_row(std::size_t task) {
  std::vector<Entry> row;
  row.reserve(alive_.size());
  for (const std::size_t c : alive_) {
    row.push_back({costs_[c][task], static_cast<std::uint32_t>(c)});
  }
  quality_.add_row(row);
  ranks_.add_row(std::move(row));
}

void Race::run_test(RaceStep& step) {
  const std::vector<std::size_t> worse = worse_by_test(step);
  std::vector<std::size_t> dropped;
  for (const std::size_t c : worse) {
    if (progress_.protection[c] > 0) continue;
    dropped.push_back(c);
    step.eliminations.push_back({contestants_[c].id, ranks_.rank_sum(c), EliminationReason::Test});
  }
  step.marker = !dropped.empty() ? '-' : (worse.empty() ? '=' : '!');
  if (!dropped.empty()) drop(dropped);
}

std::vector<std::size_t> Race::worse_by_test(RaceStep& step) {
  const double alpha = 1 - settings_.confidence;
  switch (settings_.test_type) {
    case TestType::FTest:
    case TestType::TTest:
    case TestType::TTestBonferroni:
    case TestType::TTestHolm:
      break;
  }
  if (alive_.size() > 2) {
    TestResult result = friedman_test(ranks_, alive_, alpha, quantiles_);
    if (!std::isnan(result.p_value)) {
      step.statistic = result.statistic;
      step.p_value = result.p_value;
    }
    return std::move(result.dropped);
  }
  const std::size_t tasks = progress_.task;
  const PairedResult result = wilcoxon_test(std::span(costs_[alive_[0]]).first(tasks),
                                            std::span(costs_[alive_[1]]).first(tasks), alpha);
  step.statistic = result.statistic;
  step.p_value = result.p_value;
  if (result.drops_first) return {alive_[0]};
  if (result.drops_second) return {alive_[1]};
  return {};
}

void Race::drop(const std::vector<std::size_t>& columns) {
  std::erase_if(alive_, [&](std::size_t c) { return contains(columns, c); });
  std::vector<bool> keeps(contestants_.size(), false);
  for (const std::size_t c : alive_)
    keeps[c] = true;
  ranks_.keep(keeps);
  find_uncovered();
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

void Race::find_uncovered() {
  uncovered_ = static_cast<std::size_t>(settings_.new_pairs + settings_.past_pairs);
  const auto anybody_has = [&](std::size_t task) {
    return std::any_of(alive_.begin(), alive_.end(),
                       [&](std::size_t c) { return has_result(c, task); });
  };
  while (uncovered_ > 0 && anybody_has(uncovered_ - 1))
    --uncovered_;
}

void Race::describe_best(RaceStep& step) const {
  const auto best = *std::min_element(alive_.begin(), alive_.end(), [&](auto a, auto b) {
    return ranks_.rank_sum(a) < ranks_.rank_sum(b);
  });
  double sum = 0;
  for (std::size_t task = 0; task < progress_.task; ++task)
    sum += costs_[best][task];
  step.best = contestants_[best].id;
  step.mean_best = sum / static_cast<double>(progress_.task);
}

void Race::describe_agreement(RaceStep& step) const {
  step.kendall_w = kendall_w(ranks_, alive_);
  step.spearman_rho = spearman_rho(ranks_, alive_);
  step.qvar = quality_.value(alive_);
}

std::uint64_t Race::digest(const RaceStep& step) const {
  Digest digest;
  digest.add(step.task);
  for (const std::size_t c : alive_) {
    digest.add(contestants_[c].id);
    digest.add(ranks_.rank_sum(c));
  }
  digest.add(step.statistic.value_or(-1));
  digest.add(step.p_value.value_or(-1));
  return digest.value64();
}

std::vector<std::int64_t> Race::alive_ids() const {
  std::vector<std::int64_t> ids;
  for (const std::size_t c : alive_)
    ids.push_back(contestants_[c].id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::vector<RaceStep> Race::take_steps() {
  return std::exchange(steps_, {});
}

std::vector<Race::Result> Race::results(std::size_t column) const {
  const std::vector<double>& past = contestants_[column].past;
  const auto first_past = static_cast<std::size_t>(settings_.new_pairs);
  std::vector<Result> results;
  for (std::size_t task = 0; task < costs_[column].size(); ++task) {
    const bool is_past = task >= first_past && task - first_past < past.size() &&
                         !std::isnan(past[task - first_past]);
    if (is_past || std::isnan(costs_[column][task])) continue;
    results.push_back({settings_.pairs[task], costs_[column][task]});
  }
  return results;
}

std::vector<Race::Survivor> Race::survivors() const {
  std::vector<std::size_t> columns;
  std::size_t rows = 0;
  for (const std::size_t c : alive_) {
    const auto known = std::any_of(costs_[c].begin(), costs_[c].end(),
                                   [](double cost) { return !std::isnan(cost); });
    if (!known) continue;
    columns.push_back(c);
    rows = std::max(rows, costs_[c].size());
  }
  std::vector<std::vector<double>> table;
  for (const std::size_t c : columns) {
    table.push_back(costs_[c]);
    table.back().resize(rows, kNoResult);
  }
  const std::vector<double> overall = overall_ranks(table);
  std::vector<Survivor> survivors;
  for (std::size_t i = 0; i < columns.size(); ++i)
    survivors.push_back({columns[i], overall[i]});
  std::stable_sort(survivors.begin(), survivors.end(),
                   [](const Survivor& a, const Survivor& b) { return a.rank < b.rank; });
  return survivors;
}

}  // namespace swarmsmith::irace
