#include <cmath>
#include <optional>
#include <utility>

#include "base/overloaded.h"
#include "base/text/json.h"
#include "cli/output/progress_text.h"

namespace swarmsmith::cli {
namespace {

/// Empty for rows that are not events.
using Event = std::optional<JsonObject>;

/// {"v":1,"event":NAME,...
JsonObject event_object(std::string_view name) {
  return JsonObject().add("v", 1).add("event", name);
}

Event iteration_json(const IterationRow& row) {
  return event_object("iteration")
      .add("design", row.design)
      .add("iteration", row.number)
      .add("of", row.of)
      .add("budget", row.budget)
      .add("configurations", row.configurations)
      .add("elites", row.elites)
      .add("soft_restart", row.soft_restart);
}

Event step_json(const RaceStepRow& row) {
  return event_object("race_step")
      .add("design", row.design)
      .add("iteration", row.iteration)
      .add("step", row.step)
      .add("pair", row.pair)
      .add("marker", std::string_view(&row.marker, 1))
      .add("evaluated", row.evaluated)
      .add("alive_before", row.alive_before)
      .add("alive", row.alive_after)
      .add("best", row.best)
      .add("mean_best", row.mean_best)
      .add("used", row.used)
      .add("statistic", row.statistic)
      .add("p_value", row.p_value)
      .add("kendall_w", row.kendall_w)
      .add("spearman_rho", row.spearman_rho)
      .add("qvar", row.qvar);
}

Event elite_json(const EliteRow& row) {
  return event_object("elite")
      .add("design", row.design)
      .add("iteration", row.iteration)
      .add("rank", row.rank)
      .add("candidate", row.candidate)
      .add("mean", row.mean)
      .add("runs", row.runs);
}

Event state_json(const DesignStateRow& row) {
  return event_object("design")
      .add("design", row.design)
      .add("state", word_of(row.state))
      .add("iteration", row.iteration)
      .add("used", row.used)
      .add("best", row.best)
      .add("best_mean", row.best ? std::optional(row.best_mean) : std::nullopt)
      .add("reason", row.reason);
}

Event worker_json(const WorkerRow& row) {
  return event_object("worker")
      .add("worker", row.id)
      .add("state", word_of(row.state))
      .add("host", row.host)
      .add("pid", row.pid)
      .add("slots", row.slots)
      .add("done", row.done)
      .add("failed", row.failed);
}

Event failure_json(const EvaluationRow& row) {
  if (row.status == EvaluationStatus::Ok) return std::nullopt;
  return event_object("failure")
      .add("candidate", row.key.candidate)
      .add("pair", row.key.pair)
      .add("attempt", row.attempt)
      .add("worker", row.worker);
}

Event conflict_json(const ConflictRow& row) {
  return event_object("conflict")
      .add("candidate", row.key.candidate)
      .add("pair", row.key.pair)
      .add("kept_score", row.kept_score)
      .add("other_score", row.other_score)
      .add("worker", row.other_worker);
}

Event command_json(const CommandRow& row) {
  return event_object("command")
      .add("number", row.number)
      .add("kind", word_of(row.kind))
      .add("design", row.design)
      .add("step", row.step)
      .add("budget", row.kind == CommandKind::Extend ? std::optional(row.budget) : std::nullopt)
      .add("who", row.who);
}

Event event_row_json(const EventRow& row) {
  return event_object("event")
      .add("severity", row.severity)
      .add("kind", row.kind)
      .add("data", JsonPiece{row.text.empty() ? "{}" : row.text});
}

/// Adds the name of the campaign, if there are several.
std::string text_of(JsonObject event, const std::string& campaign) {
  if (!campaign.empty()) event.add("campaign", campaign);
  return event.text();
}

}  // namespace

std::string event_json(const Row& row, const std::string& campaign) {
  const auto no_event = [](const auto&) { return Event(); };
  Event event = std::visit(
      Overloaded{[](const IterationRow& iteration) { return iteration_json(iteration); },
                 [](const RaceStepRow& step) { return step_json(step); },
                 [](const EliteRow& elite) { return elite_json(elite); },
                 [](const DesignStateRow& state) { return state_json(state); },
                 [](const WorkerRow& worker) { return worker_json(worker); },
                 [](const EvaluationRow& evaluation) { return failure_json(evaluation); },
                 [](const ConflictRow& conflict) { return conflict_json(conflict); },
                 [](const EventRow& happened) { return event_row_json(happened); },
                 [](const CampaignStateRow& state) {
                   return Event(event_object("campaign").add("state", state.state));
                 },
                 [&](const CandidateRow& row_) { return no_event(row_); },
                 [&](const FailureRow& row_) { return no_event(row_); },
                 [&](const PairRow& row_) { return no_event(row_); },
                 [&](const UnusedRow& row_) { return no_event(row_); },
                 [&](const EliminationRow& row_) { return no_event(row_); },
                 [&](const CandidateTotalsRow& row_) { return no_event(row_); },
                 [&](const AttemptRow& row_) { return no_event(row_); },
                 [&](const ForgivenRow& row_) { return no_event(row_); },
                 [](const CommandRow& command) { return command_json(command); }},
      row);
  return event ? text_of(*std::move(event), campaign) : "";
}

std::string progress_json(const ProgressModel& model, const LiveStatus& live,
                          const std::string& campaign) {
  const CampaignTotals totals = model.totals();
  const double seconds = seconds_left(live);
  JsonObject event = event_object("progress");
  event.add("designs", totals.designs)
      .add("designs_finished", totals.finished)
      .add("used", totals.used)
      .add("in_step", totals.in_step)
      .add("budget", totals.budget)
      .add("left", totals.left)
      .add("workers", live.workers)
      .add("slots", live.slots)
      .add("leased", live.leased)
      .add("done", live.done)
      .add("rate", live.evaluations_per_s)
      .add("eta_s", seconds < 0 ? std::nullopt : std::optional(seconds))
      .add("failed", live.failed)
      .add("rejected", live.rejected)
      .add("requeued", live.requeued)
      .add("expired", live.expired)
      .add("lost_workers", live.lost_workers)
      .add("duplicates", live.duplicates)
      .add("conflicts", live.conflicts)
      .add("unleased", live.unleased)
      .add("malformed", live.malformed)
      .add("uncommitted", live.uncommitted)
      .add("trouble", live.trouble)
      .add("launcher", live.launcher.name.empty() ? "" : to_text(live.launcher));
  return text_of(std::move(event), campaign);
}

}  // namespace swarmsmith::cli
