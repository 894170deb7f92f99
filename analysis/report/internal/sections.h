#pragma once

#include <vector>

#include "analysis/records/chosen_scores.h"
#include "analysis/report/internal/draft.h"

namespace swarmsmith {

/// The parts of the report, in order.

/// The first page: the scores as a figure and as sentences, the best machine of each mission, and
/// its runs from above.
void write_findings(ReportDraft& draft, const std::vector<DesignScore>& scores);
/// Winners by mission, their scores by source, real runs.
void write_scores(ReportDraft& draft, const std::vector<DesignScore>& scores);
/// Comparison of sources and methods by the winners' scores: tests, effect sizes, ranks.
void write_comparison(ReportDraft& draft, const std::vector<DesignScore>& scores);
/// How often the winners have each module.
void write_modules(ReportDraft& draft);
/// Drawings of all winners.
void write_machines(ReportDraft& draft, const std::vector<DesignRecord>& designs);
/// One row per design, and how fast each design improved.
void write_races(ReportDraft& draft, const std::vector<DesignRecord>& designs);
/// A chapter on one design: the machine, its elites, the course of the race, parameters, scores.
void write_design(ReportDraft& draft, const DesignRecord& design);
/// The question of the campaign: missions and methods.
void write_question(ReportDraft& draft);
/// Options of the race and of the simulator.
void write_settings(ReportDraft& draft);
/// Versions, seeds, digests, hosts, times, failures.
void write_provenance(ReportDraft& draft);

}  // namespace swarmsmith
