#include "analysis/comparison/comparison.h"

#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/records/names.h"
#include "analysis/report/internal/sections.h"
#include "analysis/statistics/effect_size.h"
#include "base/plain_text.h"

namespace swarmsmith {
namespace {

std::string shown_p(const std::optional<double>& p) {
  constexpr double kLeastShown = 0.0001;
  if (!p) return "-";
  return *p < kLeastShown ? "< 0.0001" : fmt::format("{:.2g}", *p);
}

HtmlTable pairs_table(const Comparison& comparison) {
  const bool by_source = comparison.options.by == CompareBy::Source;
  HtmlTable table{
      .caption = fmt::format(
          "{}; {}. Holm's correction is over {}; A12 is the chance that the first is larger; the "
          "difference is of means, first - second, with the 95 % "
          "interval of {} bootstrap resamples.",
          by_source ? "The same winners in two sources: Wilcoxon's signed-rank test, two-sided"
                    : "Two methods in the same source: Wilcoxon's rank-sum test, two-sided",
          comparison.said, counted(corrected_tests(comparison.pairs), "test"), kResamples),
      .columns = {{"mission"},
                  {by_source ? "method" : "source"},
                  {"first"},
                  {"second"},
                  {"n", true},
                  {"statistic", true},
                  {"p", true},
                  {"p by Holm", true},
                  {"A12", true},
                  {"difference", true},
                  {"p is"},
                  {"notes"}}};
  for (const ComparedPair& pair : comparison.pairs) {
    const std::string n = pair.paired || pair.n_first == pair.n_second
                              ? fmt::format("{}", pair.n_first)
                              : fmt::format("{}, {}", pair.n_first, pair.n_second);
    table.rows.push_back(
        {as_words(pair.mission), by_source ? pair.method : pair.source, pair.first, pair.second, n,
         shown_number(pair.test.statistic), shown_p(pair.test.p_value), shown_p(pair.p_holm),
         fmt::format("{:.2f}, {}", pair.a12, magnitude_of(pair.a12)),
         fmt::format("{} [{}, {}]", shown_number(pair.difference.value),
                     shown_number(pair.difference.low), shown_number(pair.difference.high)),
         std::string(method_of(pair.test)), fmt::format("{}", fmt::join(pair.notes, "; "))});
  }
  return table;
}

HtmlTable ranks_table(const ComparedRanks& ranks) {
  const FriedmanTest& test = ranks.test;
  HtmlTable table{
      .caption = fmt::format(
          "Mean ranks{} over {} of {}, 1 is best. Friedman's chi-squared {}, degrees of "
          "freedom {}, p {}. {}",
          ranks.source.empty() ? "" : " in " + ranks.source, counted(test.blocks, "block"),
          as_words(fmt::format("{}", fmt::join(ranks.missions, ", "))),
          shown_number(test.statistic), test.degrees, shown_p(test.p_value), test.reading()),
      .columns = {{"name"}, {"mean rank", true}, {"95 % interval", true}}};
  for (std::size_t i = 0; i < ranks.names.size(); ++i) {
    const double mean = test.mean_ranks[i];
    const auto interval = test.told_interval(i);
    table.rows.push_back({ranks.names[i], shown_number(mean),
                          interval ? fmt::format("[{}, {}]", shown_number(interval->low),
                                                 shown_number(interval->high))
                                   : "-"});
  }
  return table;
}

}  // namespace

void write_comparison(ReportDraft& draft, const std::vector<DesignScore>& scores) {
  const auto is_other = [&](const DesignScore& score) {
    return score.source != scores.front().source || score.method != scores.front().method;
  };
  if (std::ranges::none_of(scores, is_other)) return;
  HtmlPage& page = draft.page();
  page.heading(2, "Comparison");
  for (const CompareBy by : {CompareBy::Source, CompareBy::Method}) {
    std::set<std::string> names;
    for (const DesignScore& score : scores)
      names.insert(by == CompareBy::Source ? score.source : score.method);
    if (names.size() < 2) continue;
    const Comparison comparison = draft.take(compare(draft.store(), scores, {.by = by}));
    page.table(pairs_table(comparison));
    for (const ComparedRanks& ranks : comparison.ranks)
      page.table(ranks_table(ranks));
    for (const std::string& note : comparison.notes)
      page.paragraph(note);
  }
  draft.figure("ranks", {.width_mm = 84},
               "Mean ranks, with intervals where Friedman's test finds a difference.");
}

}  // namespace swarmsmith
