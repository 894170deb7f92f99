#pragma once

#include <vector>

#include "analysis/records/chosen_scores.h"
#include "analysis/report/internal/draft.h"

namespace swarmsmith {

/// The report's parts, in its order.

/// The first page: the scores as a figure and as sentences, the best machine of each mission, and
/// its runs from above.
void write_findings(ReportDraft& draft, const std::vector<DesignScore>& scores);
/// Winners by mission, their scores by source, real runs.
void write_scores(ReportDraft& draft, const std::vector<DesignScore>& scores);
/// Sources and methods by the winners' scores: tests, effect sizes, ranks.
void write_comparison(ReportDraft& draft, const std::vector<DesignScore>& scores);
/// How often the winners have each module.
void write_modules(ReportDraft& draft);
/// Every winner, drawn.
void write_machines(ReportDraft& draft, const std::vector<DesignRecord>& designs);
/// A row a design, and how fast it got better.
void write_races(ReportDraft& draft, const std::vector<DesignRecord>& designs);
/// A chapter: the machine, its elites, how the race went, parameters, scores.
void write_design(ReportDraft& draft, const DesignRecord& design);
/// What was asked: missions and methods.
void write_question(ReportDraft& draft);
/// Options of the race and of the simulator.
void write_settings(ReportDraft& draft);
/// Versions, seeds, digests, hosts, times, failures.
void write_provenance(ReportDraft& draft);

}  // namespace swarmsmith
