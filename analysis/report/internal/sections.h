#pragma once

#include <vector>

#include "analysis/report/internal/draft.h"

namespace swarmsmith {

/// The report's parts, in its order; each in a file of its own.

/// What was asked: campaigns, missions, methods, budget.
void write_question(ReportDraft& draft);
/// Winners by mission, their scores by source, modules.
void write_results(ReportDraft& draft);
/// Sources and methods by the winners' scores: tests, effect sizes, ranks.
void write_comparison(ReportDraft& draft, const std::vector<DesignScore>& scores);
/// A chapter: the machine, its elites, how the race went, parameters, scores.
void write_design(ReportDraft& draft, const DesignRecord& design);
/// Versions, seeds, digests, hosts, times, failures.
void write_provenance(ReportDraft& draft);

/// Options of the race and of the simulator.
void write_settings(ReportDraft& draft);

}  // namespace swarmsmith
