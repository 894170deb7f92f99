#include <string>

#include <fmt/format.h>

#include "analysis/records/names.h"
#include "analysis/report/internal/sections.h"
#include "storage/stored_enums.h"

namespace swarmsmith {
namespace {

/// `text` with every "#" replaced by the design's number.
std::string of_design(std::string_view text, DesignId design) {
  std::string result;
  for (const char letter : text)
    result += letter == '#' ? fmt::format("{}", design.value) : std::string(1, letter);
  return result;
}

void write_machine(ReportDraft& draft, const DesignRecord& design) {
  if (!design.best) return;
  const std::string name = to_string(*design.best);
  draft.page().heading(3, fmt::format("The winner of {}", to_string(design.design)), false);
  if (!design.flavour.empty()) {
    draft.figure(
        "machine",
        {.filter = {.design = design.design}, .width_mm = kWholeWidth, .candidate = design.best},
        fmt::format("{}: a circle is a state with its behaviour, a double one the initial "
                    "state; between them the conditions with their parameters.",
                    name));
  }
  const std::string flavour =
      design.flavour.empty() ? "" : fmt::format(", of the flavour {}", design.flavour);
  draft.page().verbatim(fmt::format("{} as text{}:", name, flavour), design.machine);
}

void write_race(ReportDraft& draft, const DesignRecord& design) {
  const FigureOptions whole{.filter = {.design = design.design}, .width_mm = kWholeWidth};
  draft.page().heading(3, fmt::format("The race of {}", to_string(design.design)), false);
  draft.figure("convergence", {.filter = {.design = design.design}, .width_mm = kColumnWidth},
               "Mean score of the best candidate over the experiments used.");
  draft.table(
      "Iterations (v_iterations, v_race_steps, v_eliminations, v_convergence). A mean is that of "
      "the best candidate at the end of the iteration, over n pairs.",
      {{"iteration", Show::Count},
       {"candidates", Show::Count},
       {"elites before", Show::Count},
       {"steps", Show::Count},
       {"tests", Show::Count},
       {"dropped", Show::Count},
       {"experiments", Show::Count},
       {"used so far", Show::Count},
       {"soft restart", Show::YesNo},
       {"best", Show::Candidate},
       {"mean", Show::Number},
       {"n", Show::Count}},
      of_design(
          "SELECT i.iteration, i.configurations, i.elites, s.steps, s.tests, "
          "(SELECT count(*) FROM v_eliminations AS x WHERE x.design = # AND "
          "x.iteration = i.iteration), s.evaluated, s.used, i.soft_restart, c.candidate, c.mean, "
          "c.n FROM v_iterations AS i LEFT JOIN (SELECT iteration, count(*) AS steps, "
          "count(p_value) AS tests, sum(evaluated) AS evaluated, max(used) AS used "
          "FROM v_race_steps WHERE design = # GROUP BY iteration) AS s "
          "ON s.iteration = i.iteration LEFT JOIN v_convergence AS c ON c.design = # AND "
          "c.iteration = i.iteration AND c.rank = 1 WHERE i.design = # ORDER BY i.iteration",
          design.design));
  draft.figure("race", whole,
               "The race: candidates by pairs, coloured by rank, up to the step that dropped "
               "them.");
  draft.table("Elites at the end of the last iteration (v_convergence, v_candidates).",
              {{"rank", Show::Count},
               {"candidate", Show::Candidate},
               {"mean", Show::Number},
               {"pairs", Show::Count},
               {"sampled in iteration", Show::Count},
               {"parent", Show::Candidate},
               {"states", Show::Count},
               {"transitions", Show::Count}},
              of_design("SELECT e.rank, e.candidate, e.mean, e.n, c.iteration, c.parent, "
                        "c.n_states, c.n_transitions FROM v_convergence AS e JOIN v_candidates AS "
                        "c ON c.candidate = e.candidate WHERE e.design = # AND e.iteration = "
                        "(SELECT max(iteration) FROM v_convergence WHERE design = #) "
                        "ORDER BY e.rank",
                        design.design));
  draft.table("Pairs of instance and seed that candidates were raced on (v_evaluations).",
              {{"pair", Show::Count},
               {"instance", Show::Count},
               {"seed", Show::Count},
               {"candidates", Show::Count},
               {"rejected", Show::Count},
               {"least", Show::Number},
               {"mean", Show::Number},
               {"most", Show::Number}},
              of_design("SELECT pair, instance, seed, count(*), sum(status <> 'ok'), min(score), "
                        "avg(score), max(score) FROM v_evaluations WHERE design = # AND "
                        "purpose = 'race' AND used GROUP BY pair ORDER BY pair",
                        design.design),
              120);
}

void write_parameters(ReportDraft& draft, const DesignRecord& design) {
  draft.page().heading(3, fmt::format("Parameters of {}", to_string(design.design)), false);
  const FigureOptions whole{.filter = {.design = design.design}, .width_mm = kWholeWidth};
  draft.figure("sampling", whole, "Values that were sampled, by iteration.");
  draft.figure("parallel", whole, "Parameters of the elites.");
  if (!design.best) return;
  draft.table(
      fmt::format(
          "Parameters of {} beside all values that were tried (v_parameters); a range is of "
          "numbers.",
          to_string(*design.best)),
      {{"parameter"},
       {"value", Show::Number},
       {"candidates with it", Show::Count},
       {"different values", Show::Count},
       {"least tried", Show::Number},
       {"most tried", Show::Number}},
      of_design(fmt::format("SELECT b.parameter, b.value, count(*), count(DISTINCT p.value), "
                            "iif(typeof(b.value) = 'text', NULL, min(p.value)), "
                            "iif(typeof(b.value) = 'text', NULL, max(p.value)) "
                            "FROM (SELECT parameter, value FROM v_parameters WHERE candidate = {}) "
                            "AS b JOIN v_parameters AS p ON p.parameter = b.parameter WHERE "
                            "p.design = # GROUP BY b.parameter ORDER BY b.parameter",
                            design.best->value),
                design.design));
}

void write_scores(ReportDraft& draft, const DesignRecord& design) {
  draft.table(
      "Evaluations outside of the race, of the winner and of other machines (v_evaluations). "
      "Higher is better.",
      {{"candidate", Show::Candidate},
       {"source"},
       {"purpose"},
       {"runs", Show::Count},
       {"least", Show::Number},
       {"mean", Show::Number},
       {"most", Show::Number}},
      of_design("SELECT candidate, source, purpose, count(score), min(score), avg(score), "
                "max(score) FROM v_evaluations WHERE design = # AND purpose IN " +
                    words_in_sql(is_score_of_winner) +
                    " GROUP BY candidate, source, purpose ORDER BY candidate, purpose, source",
                design.design));
}

}  // namespace

void write_design(ReportDraft& draft, const DesignRecord& design) {
  HtmlPage& page = draft.page();
  page.begin_chapter();
  page.heading(2, fmt::format("Design {}: {}, {}, repetition {}", to_string(design.design),
                              as_words(design.mission), design.method, design.repetition));
  std::vector<std::pair<std::string, std::string>> facts{
      {"state", design.state},
      {"experiments", design.budget > 0 ? fmt::format("{} of {}", design.used, design.budget)
                                        : fmt::format("{}", design.used)},
      {"iterations", fmt::format("{}", design.iteration)}};
  if (design.best) facts.emplace_back("winner", to_string(*design.best));
  if (design.best_mean) facts.emplace_back("its mean in the race", shown_number(*design.best_mean));
  page.facts("How it ended (v_designs).", facts);
  write_machine(draft, design);
  write_scores(draft, design);
  write_race(draft, design);
  write_parameters(draft, design);
  page.end_chapter();
}

}  // namespace swarmsmith
