#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "analysis/report/internal/score_table.h"
#include "analysis/report/internal/sections.h"

namespace swarmsmith {
namespace {

/// A page of a paper, for figures of all designs.
constexpr double kWholeWidth = 174;
constexpr double kColumnWidth = 84;
constexpr double kMiddleWidth = 120;

void write_modules(ReportDraft& draft) {
  const auto all = draft.take(module_frequencies(draft.store(), {}));
  if (all.empty()) return;
  draft.page().heading(3, "Modules of the winners");
  draft.figure("modules", {.width_mm = kWholeWidth},
               "Modules of the winners: mean occurrences, and the part of the winners that have "
               "them.");
  std::map<std::pair<std::string, std::string>, HtmlTable> tables;
  for (const ModuleFrequency& module : all) {
    HtmlTable& table = tables[{module.mission, module.method}];
    if (table.rows.empty()) {
      table.caption = fmt::format("Modules of the winners of {} by {} (v_module_frequency).",
                                  module.mission, module.method);
      table.columns = {{"module"}, {"mean occurrences", true}, {"occurrence rate", true}};
    }
    table.rows.push_back({module.module, fmt::format("{:.2f}", module.average_occurrences),
                          fmt::format("{:.0f} %", 100 * module.occurrence_rate)});
  }
  for (const auto& entry : tables)
    draft.page().table(entry.second);
}

/// Filmed runs, those that do not count included; stores before schema 5 have no view of them.
void write_real_runs(ReportDraft& draft) {
  if (draft.store().schema() < 5) return;
  draft.table(
      "Real runs (v_real_runs). Those that count are among the scores above; the others are "
      "INVALID, "
      "or biased since a tag was taken for its robot's centre.",
      {{"run"},
       {"name"},
       {"mission"},
       {"machine", Show::Candidate},
       {"recorded"},
       {"score", Show::Number},
       {"verdict"},
       {"overridden by"},
       {"reason"},
       {"counts", Show::YesNo}},
      "SELECT id, name, mission, candidate, recorded, score, verdict, overridden_by, reason, "
      "counts "
      "FROM v_real_runs ORDER BY run",
      1000);
}

}  // namespace

void write_results(ReportDraft& draft) {
  draft.page().heading(2, "Results");
  draft.table(
      "Winners by mission, by their mean score in the test, else in the race "
      "(v_leaderboard). Higher is better.",
      {{"mission"},
       {"rank", Show::Count},
       {"design", Show::Design},
       {"method"},
       {"repetition", Show::Count},
       {"winner", Show::Candidate},
       {"mean in the test", Show::Number},
       {"test runs", Show::Count},
       {"mean in the race", Show::Number}},
      "SELECT mission, rank, design, method, repetition, candidate, test_mean, test_runs, "
      "race_mean FROM v_leaderboard ORDER BY mission, rank, design",
      1000);
  const auto scores = draft.take(design_scores(draft.store(), {}));
  const ChosenScores taken = chosen(scores, {});
  draft.page().heading(3, "Scores after the race");
  if (scores.empty()) draft.page().paragraph("No winner was evaluated outside of its race.");
  draft.page().table(score_table(
      "Scores of the winners by mission, method, source and purpose (v_design_scores): \"test\" on "
      "the campaign's own seeds, \"score\" asked for later; " +
          taken.said + ". Higher is better.",
      taken));
  draft.figure("box", {.width_mm = kWholeWidth},
               "Scores of the winners; " + taken.said + ". Higher is better.");
  draft.figure("scores", {.width_mm = kWholeWidth},
               "How often the winners had each score; " + taken.said + ".");
  write_real_runs(draft);
  draft.figure("convergence", {.width_mm = kMiddleWidth},
               "Mean score of each design's best machine over the experiments used.");
  if (!scores.empty()) write_comparison(draft, scores);
  draft.figure("ranks", {.width_mm = kColumnWidth},
               "Mean ranks with the interval of Friedman's test.");
  write_modules(draft);
}

}  // namespace swarmsmith
