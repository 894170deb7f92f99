#include <string>

#include <fmt/format.h>

#include "analysis/report/internal/sections.h"

namespace swarmsmith {
namespace {

void write_campaigns(ReportDraft& draft) {
  draft.table("Campaigns (v_campaigns). Each digest covers everything that decides the answer.",
              {{"campaign"},
               {"seed", Show::Count},
               {"digest"},
               {"engine", Show::Count},
               {"state"},
               {"begun (UTC)"},
               {"finished (UTC)"}},
              "SELECT name, seed, digest, json_extract(deciding, '$.\"engine.version\"'), state, "
              "created, finished FROM v_campaigns ORDER BY campaign");
}

void write_work(ReportDraft& draft) {
  draft.table("Evaluations (v_evaluations). Times are sums over all workers.",
              {{"purpose"},
               {"source"},
               {"evaluations", Show::Count},
               {"used", Show::Count},
               {"rejected", Show::Count},
               {"seconds", Show::Number},
               {"most attempts", Show::Count}},
              "SELECT purpose, source, count(*), sum(used), sum(status <> 'ok'), "
              "sum(wall_ms) / 1000, max(attempt) FROM v_evaluations GROUP BY purpose, source "
              "ORDER BY purpose, source");
  draft.table("Hosts (v_workers).",
              {{"host"},
               {"processor"},
               {"build"},
               {"workers", Show::Count},
               {"slots", Show::Count},
               {"done", Show::Count},
               {"failed", Show::Count},
               {"first seen (UTC)"},
               {"last seen (UTC)"}},
              "SELECT host, cpu, build, count(*), sum(slots), sum(done), sum(failed), "
              "min(first_seen), max(last_seen) FROM v_workers GROUP BY host, cpu, build "
              "ORDER BY host, cpu, build");
}

void write_faults(ReportDraft& draft) {
  draft.table("Attempts without a result (v_failures).",
              {{"reason"}, {"attempts", Show::Count}, {"candidates", Show::Count}},
              "SELECT reason, count(*), count(DISTINCT candidate) FROM v_failures GROUP BY reason "
              "ORDER BY count(*) DESC, reason",
              50);
  draft.table("Leases that did not end with their result (v_attempts).",
              {{"outcome"}, {"leases", Show::Count}},
              "SELECT outcome, count(*) FROM v_attempts GROUP BY outcome ORDER BY outcome");
  draft.table("Commands that people gave (v_commands).",
              {{"number", Show::Count},
               {"command"},
               {"design", Show::Design},
               {"more experiments", Show::Count},
               {"acted at step", Show::Count},
               {"by"},
               {"at (UTC)"}},
              "SELECT number, kind, design, budget, step, who, at FROM v_commands ORDER BY number");
}

}  // namespace

void write_provenance(ReportDraft& draft) {
  HtmlPage& page = draft.page();
  page.begin_folded("Where it comes from");
  write_campaigns(draft);
  std::vector<std::pair<std::string, std::string>> facts{
      {"report by", draft.options().program}, {"digest of the answer", draft.store().digest()}};
  const auto totals = draft.take(
      view_facts(draft.store(),
                 "SELECT 'evaluations with two results', sum(conflicts) FROM v_campaign_status "
                 "UNION ALL SELECT 'attempts without a result', count(*) FROM v_failures"));
  facts.insert(facts.end(), totals.begin(), totals.end());
  page.facts("The store.", facts);
  page.paragraph(
      "`swarmsmith digest STORE` prints the digest of the answer: two stores of a campaign have "
      "the "
      "same, whatever workers made them. `swarmsmith verify STORE` plays all races again from "
      "their "
      "scores; `swarmsmith replay` simulates a stored evaluation again.");
  draft.table("Seeds of the races (v_designs).",
              {{"design", Show::Design}, {"seed", Show::Count}, {"flavour"}},
              "SELECT design, seed, flavour FROM v_designs ORDER BY design", 1000);
  write_work(draft);
  write_faults(draft);
  page.end_folded();
}

}  // namespace swarmsmith
