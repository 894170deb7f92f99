#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/records/chosen_scores.h"
#include "analysis/records/names.h"
#include "analysis/report/html.h"
#include "analysis/report/internal/sections.h"
#include "analysis/statistics/summary.h"

namespace swarmsmith {
namespace {

/// A width for figures of all designs, so that they fit on a page of a paper.
constexpr double kMiddleWidth = 120;

struct ScoreGroup {
  std::set<DesignId> designs;
  std::vector<double> values;
};

/// Mission, method, whether it is not a test, source, purpose. So the source of the campaign's own
/// tests comes first.
using Key = std::tuple<std::string, std::string, bool, std::string, std::string>;

/// One row for each mission, method, source and purpose: number, mean, standard deviation, and the
/// five numbers of a box plot (analysis/statistics/summary.h).
HtmlTable score_table(const std::string& caption, const ChosenScores& taken) {
  HtmlTable table{.caption = caption,
                  .columns = {{"mission"}, {"method"}, {"source"}, {"purpose"}, {"designs", true}}};
  for (const char* number :
       {"n", "mean", "sd", "least", "1st quartile", "median", "3rd quartile", "most"}) {
    table.columns.push_back({number, true});
  }
  std::map<Key, ScoreGroup> found;
  for (const auto& [score, runs] : values_of(taken)) {
    ScoreGroup& group =
        found[{score.mission, score.method, score.purpose != "test", score.source, score.purpose}];
    group.designs.insert(score.design);
    group.values.push_back(score.score);
  }
  for (const auto& [key, group] : found) {
    const auto& [mission, method, is_later, source, purpose] = key;
    const Summary summary = summary_of(group.values);
    std::vector<std::string> row = {as_words(mission),
                                    method,
                                    source,
                                    purpose,
                                    fmt::format("{}", group.designs.size()),
                                    fmt::format("{}", summary.n),
                                    shown_number(summary.mean),
                                    summary.n < 2 ? "-" : shown_number(summary.sd)};
    for (const double value : {summary.least, summary.lower_quartile, summary.median,
                               summary.upper_quartile, summary.most}) {
      row.push_back(shown_number(value));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Filmed runs, including those that do not count. Stores before schema 5 have no view of them.
void write_real_runs(ReportDraft& draft) {
  if (draft.store().schema() < 5) return;
  draft.table(
      "Real runs (v_real_runs). Those that count are among the scores above; the others are "
      "INVALID, or biased since a tag was used as its robot's centre.",
      {{"run"},
       {"name"},
       {"mission", Show::Name},
       {"machine", Show::Candidate},
       {"recorded"},
       {"score", Show::Number},
       {"verdict"},
       {"overridden by"},
       {"reason"},
       {"counts", Show::YesNo}},
      "SELECT id, name, mission, candidate, recorded, score, verdict, overridden_by, reason, "
      "counts FROM v_real_runs ORDER BY run",
      1000);
}

}  // namespace

void write_scores(ReportDraft& draft, const std::vector<DesignScore>& scores) {
  draft.page().heading(2, "Scores");
  draft.table(
      "Winners by mission, by their mean score in the test, else in the race "
      "(v_leaderboard). Higher is better.",
      {{"mission", Show::Name},
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
  if (!scores.empty()) {
    const ChosenScores taken = chosen(scores, {});
    draft.page().table(score_table(
        "Scores of the winners by mission, method, source and purpose (v_design_scores): \"test\" "
        "on the campaign's own seeds, \"score\" under further profiles or asked for later; " +
            taken.said + ". Higher is better.",
        taken));
    draft.figure("scores", {.width_mm = kWholeWidth},
                 "How often the winners had each score; " + taken.said + ".");
  }
  write_real_runs(draft);
}

void write_modules(ReportDraft& draft) {
  const auto all = draft.take(module_frequencies(draft.store(), {}));
  if (all.empty()) return;
  draft.page().heading(2, "Modules of the winners");
  draft.figure("modules", {.width_mm = kWholeWidth},
               "Modules of the winners: mean occurrences, and the part of the winners that have "
               "them.");
  std::map<std::pair<std::string, std::string>, HtmlTable> tables;
  for (const ModuleFrequency& module : all) {
    HtmlTable& table = tables[{module.mission, module.method}];
    if (table.rows.empty()) {
      table.caption = fmt::format("Modules of the winners of {} by {} (v_module_frequency).",
                                  as_words(module.mission), module.method);
      table.columns = {{"module"},
                       {"mean occurrences", true},
                       {"occurrence rate", true},
                       {"mean, reachable states", true},
                       {"rate, reachable states", true}};
    }
    const auto& counts = module.counts;
    table.rows.push_back(
        counts ? std::vector<std::string>{as_words(module.module),
                                          fmt::format("{:.2f}", counts->average_occurrences),
                                          fmt::format("{:.0f} %", 100 * counts->occurrence_rate),
                                          fmt::format("{:.2f}", counts->average_reachable),
                                          fmt::format("{:.0f} %", 100 * counts->reachable_rate)}
               : std::vector<std::string>{as_words(module.module), "-", "-", "-", "-"});
  }
  draft.page().begin_folded("The same as tables", false);
  for (const auto& entry : tables)
    draft.page().table(entry.second);
  draft.page().end_folded();
}

/// An explanation of the drawings, for the architectures in the store.
std::string how_to_read(ReportDraft& draft) {
  constexpr std::array kKinds = {
      std::pair{"--nstates*",
                "A circle is a state with its behaviour, a double one the initial state; between "
                "them the conditions with their parameters. Grey states cannot be reached."},
      std::pair{"--nroot*",
                "A tree's subtrees take turns from left to right: each acts until its condition "
                "holds."},
      std::pair{"--network*", "A network is its weights: inputs and wheels."}};
  std::string text;
  for (const auto& [pattern, sentence] : kKinds) {
    const auto found = draft.take(draft.store().query(
        fmt::format("SELECT 1 FROM v_designs AS d JOIN v_candidates AS c "
                    "ON c.candidate = d.best_candidate AND c.design = d.design "
                    "WHERE c.fsm_config GLOB '{}' LIMIT 1",
                    pattern),
        {}, [](const auto&) {}, [](const auto&) {}));
    if (found.rows > 0) text += (text.empty() ? "" : " ") + std::string(sentence);
  }
  return text;
}

void write_machines(ReportDraft& draft, const std::vector<DesignRecord>& designs) {
  const auto has_machine = [](const DesignRecord& design) {
    return design.best && !design.flavour.empty();
  };
  if (std::ranges::none_of(designs, has_machine)) return;
  HtmlPage& page = draft.page();
  page.heading(2, "The winners, drawn");
  page.paragraph(how_to_read(draft));
  page.begin_grid();
  for (const DesignRecord& design : designs) {
    if (!has_machine(design)) continue;
    draft.figure("machine", {.width_mm = kColumnWidth, .candidate = design.best},
                 fmt::format("{}: {}, {}, repetition {}.", to_string(design.design),
                             as_words(design.mission), design.method, design.repetition));
  }
  page.end_grid();
}

void write_races(ReportDraft& draft, const std::vector<DesignRecord>& designs) {
  HtmlPage& page = draft.page();
  page.heading(2, "Races");
  draft.figure("convergence", {.width_mm = kMiddleWidth},
               "Mean score of each design's best candidate over the experiments used.");
  draft.table(
      "Designs: one search each (v_designs).",
      {{"design", Show::Design},
       {"mission", Show::Name},
       {"method"},
       {"repetition", Show::Count},
       {"budget (experiments)", Show::Count},
       {"used", Show::Count},
       {"iterations", Show::Count},
       {"its race's mean", Show::Number},
       {"mean of its tests", Show::Number},
       {"state"},
       {"why it ended"}},
      "SELECT d.design, d.mission, d.method, d.repetition, nullif(d.budget, 0), d.used, "
      "d.iteration, "
      "d.best_mean, t.test_mean, d.state, d.reason "
      "FROM v_designs AS d LEFT JOIN v_leaderboard AS t ON t.design = d.design ORDER BY d.design",
      1000);
  if (!draft.options().page_of_design) {
    page.paragraph(
        "Each design has a chapter with its race, elites and parameters: `swarmsmith report STORE "
        "--design d1`, or `--design all`; `swarmsmith supplement` writes a page of each.");
    return;
  }
  std::vector<std::pair<std::string, std::string>> pages;
  for (const DesignRecord& design : designs) {
    if (design.best)
      pages.emplace_back(to_string(design.design), draft.options().page_of_design(design));
  }
  page.links("Race, elites and parameters of each design:", pages);
}

}  // namespace swarmsmith
