#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/svg.h"
#include "analysis/figures/design_choice.h"
#include "analysis/figures/importance.h"
#include "analysis/figures/internal/for_paper.h"
#include "analysis/figures/internal/parameter_table.h"
#include "analysis/figures/makers.h"
#include "base/plain_text.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kMostBars = 15;
constexpr std::size_t kLeastActive = 20;  ///< candidates; groups of fewer candidates are too random
constexpr std::size_t kGroupsOfNumbers = 5;

/// Horizontal bars, the longest at the top.
struct ImportancePlot {
  struct Bar {
    std::string name;
    Importance importance;
  };
  std::string title;
  std::vector<std::string> details;
  std::string caption;
  std::vector<Bar> bars;
  double width_mm = 84;
};

std::string draw(const ImportancePlot& plot) {
  constexpr double kRow = 4.6;
  constexpr double kBar = 3;
  double names = 0;
  double most = 0.01;
  for (const auto& bar : plot.bars) {
    names = std::max(names, text_width(bar.name, kTextSize));
    most = std::max({most, bar.importance.eta_squared, bar.importance.by_chance});
  }
  const auto caption = broken_text(plot.caption, kTextSize, plot.width_mm - 2 * kMargin,
                                   plot.caption.empty() ? 0 : 8);
  const double heading = kMargin + (plot.title.empty() ? 0 : kTitleSize) +
                         kLineHeight * static_cast<double>(plot.details.size()) + 2;
  PlotArea area{.left = kMargin + names + 2, .top = heading + 1};
  area.width = plot.width_mm - area.left - kMargin - 5;
  area.height = kRow * static_cast<double>(plot.bars.size());
  const double below = area.bottom() + kHorizontalAxisRoom + 2;
  Svg svg(plot.width_mm, below + kLineHeight * static_cast<double>(caption.size()) + kMargin,
          plot.title, "Bars: part of the variance of scores that each parameter explains");
  draw_heading(svg, plot.title, plot.details);
  const Axis x(rounded({0, most}, 5), area.left, area.right());
  draw_horizontal_axis(svg, area, x, "part of the variance of scores");
  const std::string color = distinct_color(0);
  for (std::size_t i = 0; i < plot.bars.size(); ++i) {
    const auto& [name, importance] = plot.bars[i];
    const double middle = area.top + kRow * (static_cast<double>(i) + 0.5);
    svg.text({area.left - 1.5, middle + 0.36 * kTextSize}, name,
             {.size = kTextSize, .anchor = TextStyle::Anchor::End, .fill = std::string(kInk)});
    const bool is_more = importance.eta_squared > importance.by_chance;
    const std::vector<PageBar> bar = {
        {{area.left, middle}, x.at(importance.eta_squared) - area.left}};
    svg.bars(bar, kBar, is_more ? color : lightened(color, 0.6), BarDirection::Right);
    const double level = x.at(importance.by_chance);
    svg.line(
        std::vector<PagePoint>{{level, middle - kBar / 2 - 0.4}, {level, middle + kBar / 2 + 0.4}},
        stroked(kInk, 0.3));
  }
  for (std::size_t i = 0; i < caption.size(); ++i) {
    svg.text({kMargin, below + kLineHeight * static_cast<double>(i) + kTextSize}, caption[i],
             {.size = kTextSize, .fill = std::string(kInk)});
  }
  return svg.finish();
}

/// The scores in all races of the design.
Expected<std::vector<ScoredPair>> scored_pairs(StoreReader& store, DesignId design) {
  const auto all = iterations(store, design);
  if (!all) return Unexpected(all.error());
  std::vector<ScoredPair> pairs;
  for (const IterationRecord& iteration : *all) {
    const auto cells = race_cells(store, design, iteration.iteration);
    if (!cells) return Unexpected(cells.error());
    for (const RaceCell& cell : *cells)
      if (cell.score) pairs.push_back({cell.candidate, cell.pair, *cell.score});
  }
  // Elites occur in every iteration to which they belong; keeps each score once.
  std::ranges::sort(pairs, {}, [](const ScoredPair& p) { return std::pair(p.candidate, p.pair); });
  const auto same = [](const ScoredPair& a, const ScoredPair& b) {
    return a.candidate == b.candidate && a.pair == b.pair;
  };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
  return pairs;
}

/// Groups the candidates that have the parameter: by category, or by fifths of its values.
std::vector<std::size_t> groups_of(const ParameterColumn& column,
                                   const std::vector<double>& values) {
  std::vector<std::size_t> groups;
  if (column.is_category()) {
    for (const double value : values)
      groups.push_back(static_cast<std::size_t>(value));
    return groups;
  }
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  for (const double value : values) {
    // Equal values have the same place, so a fifth never splits them.
    const auto place = std::ranges::lower_bound(sorted, value) - sorted.begin();
    groups.push_back(static_cast<std::size_t>(place) * kGroupsOfNumbers / sorted.size());
  }
  return groups;
}

}  // namespace

std::map<CandidateId, double> candidate_effects(const std::vector<ScoredPair>& scores) {
  constexpr int kMostSweeps = 200;
  // Uses indices instead of ids, so that a sweep needs no searches. They are in the order of the
  // ids, so that sums have the same order as in the list.
  std::map<CandidateId, std::size_t> candidates;
  std::map<std::int64_t, std::size_t> pairs;
  for (const ScoredPair& score : scores) {
    candidates.emplace(score.candidate, 0);
    pairs.emplace(score.pair, 0);
  }
  std::size_t next_number = 0;
  for (auto& [id, number] : candidates)
    number = next_number++;
  next_number = 0;
  for (auto& [id, number] : pairs)
    number = next_number++;
  struct Run {
    std::size_t candidate;
    std::size_t pair;
    double score;
  };
  std::vector<Run> runs;
  runs.reserve(scores.size());
  std::vector<double> n_of_candidate(candidates.size());
  std::vector<double> n_of_pair(pairs.size());
  for (const ScoredPair& score : scores) {
    runs.push_back({candidates.at(score.candidate), pairs.at(score.pair), score.score});
    ++n_of_candidate[runs.back().candidate];
    ++n_of_pair[runs.back().pair];
  }
  std::vector<double> effects(candidates.size());
  std::vector<double> levels(pairs.size());
  std::vector<double> next(candidates.size());
  // Alternates between the least squares for pairs and those for candidates, each with the other
  // terms fixed. A constant can move between the two terms; eta squared does not depend on it.
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    std::ranges::fill(levels, 0);
    for (const Run& run : runs)
      levels[run.pair] += (run.score - effects[run.candidate]) / n_of_pair[run.pair];
    std::ranges::fill(next, 0);
    for (const Run& run : runs)
      next[run.candidate] += (run.score - levels[run.pair]) / n_of_candidate[run.candidate];
    double moved = 0;
    double largest = 0;
    for (std::size_t i = 0; i < next.size(); ++i) {
      moved = std::max(moved, std::fabs(next[i] - effects[i]));
      largest = std::max(largest, std::fabs(next[i]));
    }
    effects.swap(next);
    if (moved <= 1e-9 * largest) break;
  }
  std::map<CandidateId, double> by_id;
  for (const auto& [id, number] : candidates)
    by_id.emplace_hint(by_id.end(), id, effects[number]);
  return by_id;
}

double eta_squared(const std::vector<std::size_t>& groups, const std::vector<double>& values) {
  struct Sum {
    double sum = 0;
    double count = 0;
  };
  std::vector<Sum> sums(groups.empty() ? 0 : std::ranges::max(groups) + 1);
  double total = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Sum& group = sums[groups[i]];
    group.sum += values[i];
    ++group.count;
    total += values[i];
  }
  const double mean = total / static_cast<double>(values.size());
  double between = 0;
  for (const Sum& group : sums) {
    if (group.count == 0) continue;
    const double distance = group.sum / group.count - mean;
    between += group.count * distance * distance;
  }
  double all = 0;
  for (const double value : values)
    all += (value - mean) * (value - mean);
  return all > 0 ? between / all : 0;
}

Importance importance_of(const std::vector<std::size_t>& groups, std::vector<double> values,
                         Rng rng) {
  constexpr std::size_t kShuffles = 200;
  constexpr std::size_t kLevel = 190;  // 95 %
  Importance importance{.eta_squared = eta_squared(groups, values)};
  std::vector<double> shuffled;
  for (std::size_t n = 0; n < kShuffles; ++n) {
    for (std::size_t i = values.size(); i > 1; --i)
      std::swap(values[i - 1], values[static_cast<std::size_t>(rng.below(i))]);
    shuffled.push_back(eta_squared(groups, values));
  }
  std::ranges::sort(shuffled);
  importance.by_chance = shuffled[kLevel - 1];
  return importance;
}

Expected<Figure> importance_figure(StoreReader& store, const FigureOptions& options) {
  const auto design = chosen_design(store, options, "importance");
  if (!design) return Unexpected(design.error());
  const auto table = read_parameter_table(store, design->design);
  if (!table) return Unexpected(table.error());
  const auto pairs = scored_pairs(store, design->design);
  if (!pairs) return Unexpected(pairs.error());
  const std::map<CandidateId, double> effects = candidate_effects(*pairs);
  ImportancePlot plot{
      .title = title_of(*design),
      .details = {fmt::format("What the scores of {} depend on, {}", to_string(design->design),
                              counted(effects.size(), "candidate"))},
      .caption =
          "Bar: part of the variance of the candidates' scores that the value of one parameter "
          "explains, without the effect of the pairs (eta squared; numbers in "
          "fifths), among candidates that have it. Mark: what chance gives in one of 20 "
          "cases; pale: no more than that.",
      .bars = {},
      .width_mm = options.width_mm};
  std::string csv = "design,parameter,candidates,groups,eta_squared,by_chance_95\n";
  for (const ParameterColumn& column : table->columns) {
    std::vector<double> values;
    std::vector<double> scores;
    for (std::size_t row = 0; row < table->candidates.size(); ++row) {
      const auto effect = effects.find(table->candidates[row].candidate);
      if (effect == effects.end() || std::isnan(column.values[row])) continue;
      values.push_back(column.values[row]);
      scores.push_back(effect->second);
    }
    if (scores.size() < kLeastActive) continue;
    const std::vector<std::size_t> groups = groups_of(column, values);
    const std::set<std::size_t> distinct(groups.begin(), groups.end());
    if (distinct.size() < 2) continue;
    const Importance importance = importance_of(groups, scores, Rng(1).split(column.name));
    csv +=
        fmt::format("{},{},{},{},{},{}\n", design->design.value, csv_field(column.name),
                    scores.size(), distinct.size(), importance.eta_squared, importance.by_chance);
    plot.bars.push_back({column.words, importance});
  }
  if (plot.bars.empty()) {
    return unexpected(ErrorKind::NotFound,
                      fmt::format("no parameter of {} is in {} candidates with a score",
                                  to_string(design->design), kLeastActive));
  }
  std::ranges::stable_sort(plot.bars, std::greater<>(), [](const auto& bar) {
    const Importance& importance = bar.importance;
    return std::pair(importance.eta_squared > importance.by_chance, importance.eta_squared);
  });
  if (plot.bars.size() > kMostBars) {
    plot.details.push_back(
        fmt::format("{} of {} parameters: beyond chance first", kMostBars, plot.bars.size()));
    plot.bars.resize(kMostBars);
  }
  return Figure{.svg = draw(for_paper(plot, options)), .csv = std::move(csv), .tex = {}};
}

}  // namespace swarmsmith
