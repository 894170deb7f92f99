#include "analysis/comparison/comparison_text.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/comparison/comparison_tables.h"
#include "analysis/statistics/effect_size.h"
#include "base/plain_text.h"
#include "base/shown_text.h"
#include "base/text/text_table.h"

namespace swarmsmith {
namespace {

std::string shown(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "-";
}

/// Four significant digits, as R prints a p-value.
std::string shown_p(std::optional<double> p) {
  return p ? fmt::format("{:.4g}", *p) : "-";
}

std::string groups_text(const Comparison& comparison) {
  TextTable table{.aligns = std::vector<Align>(3, Align::Left),
                  .rows = {{"mission", "method", "source", "n", "designs", "runs", "mean", "sd",
                            "min", "q1", "median", "q3", "max"}}};
  for (const ComparedGroup& group : comparison.groups) {
    const Summary& summary = group.summary;
    table.rows.push_back({group.mission, group.method, group.source, fmt::format("{}", summary.n),
                          fmt::format("{}", group.designs), fmt::format("{}", group.runs),
                          shown(summary.mean), shown(summary.sd), shown(summary.least),
                          shown(summary.lower_quartile), shown(summary.median),
                          shown(summary.upper_quartile), shown(summary.most)});
  }
  return aligned(std::move(table));
}

/// Lists each note once and numbers the notes; rows refer to these numbers.
class Footnotes {
 public:
  /// "1 3"; empty if there are no notes.
  std::string numbers_of(const std::vector<std::string>& notes) {
    std::vector<std::size_t> numbers;
    for (const std::string& note : notes) {
      const auto known = std::ranges::find(notes_, note);
      numbers.push_back(static_cast<std::size_t>(known - notes_.begin()) + 1);
      if (known == notes_.end()) notes_.push_back(note);
    }
    return fmt::format("{}", fmt::join(numbers, " "));
  }

  std::string text() const {
    std::string text;
    for (std::size_t i = 0; i < notes_.size(); ++i)
      text += fmt::format("  {}) {}\n", i + 1, as_shown(notes_[i], Layout::Escaped));
    return text;
  }

 private:
  std::vector<std::string> notes_;
};

std::string pairs_text(const Comparison& comparison) {
  const bool paired = comparison.options.by == CompareBy::Source;
  TextTable table{
      .aligns = std::vector<Align>(4, Align::Left),
      .rows = {{"mission", paired ? "method" : "source", "first", "second", "n", paired ? "V" : "W",
                "p", "Holm's p", "p is", "A12", "effect", "difference", "95 % interval", "notes"}}};
  Footnotes footnotes;
  for (const ComparedPair& pair : comparison.pairs) {
    table.rows.push_back(
        {pair.mission, pair.paired ? pair.method : pair.source, pair.first, pair.second,
         pair.paired ? fmt::format("{}", pair.n_first)
                     : fmt::format("{}+{}", pair.n_first, pair.n_second),
         shown(pair.test.statistic), shown_p(pair.test.p_value), shown_p(pair.p_holm),
         pair.test.exact ? "exact" : "normal", fmt::format("{:.3f}", pair.a12),
         std::string(magnitude_of(pair.a12)), shown(pair.difference.value),
         fmt::format("[{}, {}]", shown(pair.difference.low), shown(pair.difference.high)),
         footnotes.numbers_of(pair.notes)});
  }
  return aligned(std::move(table)) + footnotes.text();
}

std::string ranks_text(const ComparedRanks& ranks) {
  const FriedmanTest& test = ranks.test;
  TextTable table{.aligns = std::vector<Align>(1, Align::Left),
                  .rows = {{"", "mean rank", "95 % interval"}}};
  for (std::size_t i = 0; i < ranks.names.size(); ++i) {
    const double mean = test.mean_ranks[i];
    const auto interval = test.told_interval(i);
    table.rows.push_back(
        {ranks.names[i], fmt::format("{:.3f}", mean),
         interval ? fmt::format("[{:.3f}, {:.3f}]", interval->low, interval->high) : "-"});
  }
  std::string text = fmt::format(
      "Ranks of mean scores{} over {} ({}{}): Friedman chi-squared {}, {} of freedom, "
      "p {}\n",
      ranks.source.empty() ? "" : " in " + ranks.source, fmt::join(ranks.missions, ", "),
      counted(test.blocks, "block"),
      ranks.incomplete == 0 ? "" : fmt::format(", incomplete and left out: {}", ranks.incomplete),
      shown(test.statistic), counted(test.degrees, "degree"), shown_p(test.p_value));
  return fmt::format("{}{}{}\n", text, aligned(std::move(table)), test.reading());
}

std::string how_it_was_tested(const Comparison& comparison) {
  if (comparison.pairs.empty()) return "";
  const bool paired = comparison.pairs.front().paired;
  const bool exact = std::ranges::any_of(comparison.pairs,
                                         [](const ComparedPair& pair) { return pair.test.exact; });
  const bool normal = std::ranges::any_of(
      comparison.pairs, [](const ComparedPair& pair) { return !pair.test.exact; });
  const std::size_t tests = corrected_tests(comparison.pairs);
  std::string text =
      fmt::format("p: Wilcoxon {} test, two-sided{}{}; Holm's over {}.\n",
                  paired ? "signed-rank" : "rank-sum", exact ? "; exact without ties" : "",
                  normal ? "; normal approximation with correction for ties and "
                           "continuity"
                         : "",
                  counted(tests, "test"));
  text += fmt::format(
      "A12: chance that the first is larger. Difference: of means, first - second; {} bootstrap "
      "resamples, seed {}.\n",
      kResamples, kBootstrapSeed);
  return text;
}

}  // namespace

std::string comparison_text(const Comparison& comparison) {
  std::string text =
      fmt::format("Scores of the designs' winners, larger is better; {}.\n\n", comparison.said);
  text += groups_text(comparison);
  if (!comparison.pairs.empty()) text += "\n" + pairs_text(comparison);
  for (const ComparedRanks& ranks : comparison.ranks)
    text += "\n" + ranks_text(ranks);
  const std::string how = how_it_was_tested(comparison);
  if (!how.empty()) text += "\n" + how;
  if (!comparison.notes.empty()) text += "\n";
  for (const std::string& note : comparison.notes)
    text += as_shown(note, Layout::Escaped) + "\n";
  return text;
}

}  // namespace swarmsmith
