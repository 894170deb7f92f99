#include <cmath>
#include <optional>

#include "base/overloaded.h"
#include "cli/output/progress_text.h"
#include "console/output.h"

namespace swarmsmith::cli {
namespace {

/// Puts {"v":1,"event":NAME,...} together.
class EventText {
 public:
  explicit EventText(std::string_view event) : text_("{\"v\":1,\"event\":" + json_text(event)) {}

  EventText& add(std::string_view key, std::int64_t value) {
    return raw(key, std::to_string(value));
  }
  EventText& add(std::string_view key, double value) { return raw(key, json_number(value)); }
  EventText& add(std::string_view key, const std::optional<double>& value) {
    return raw(key, value ? json_number(*value) : "null");
  }
  EventText& add(std::string_view key, bool value) { return raw(key, value ? "true" : "false"); }
  EventText& add(std::string_view key, std::string_view value) {
    return raw(key, json_text(value));
  }
  template <class Tag>
  EventText& add(std::string_view key, Id<Tag> id) {
    return raw(key, id ? json_text(to_string(id)) : "null");
  }
  /// `value` is JSON.
  EventText& raw(std::string_view key, std::string_view value) {
    text_ += "," + json_text(key) + ":" + std::string(value);
    return *this;
  }
  std::string str() const { return text_ + "}"; }

 private:
  std::string text_;
};

std::string iteration_json(const IterationRow& row) {
  return EventText("iteration")
      .add("design", row.design)
      .add("iteration", row.number)
      .add("of", row.of)
      .add("budget", row.budget)
      .add("configurations", row.configurations)
      .add("elites", row.elites)
      .add("soft_restart", row.soft_restart)
      .str();
}

std::string step_json(const RaceStepRow& row) {
  return EventText("race_step")
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
      .add("qvar", row.qvar)
      .str();
}

std::string elite_json(const EliteRow& row) {
  return EventText("elite")
      .add("design", row.design)
      .add("iteration", row.iteration)
      .add("rank", row.rank)
      .add("candidate", row.candidate)
      .add("mean", row.mean)
      .add("runs", row.runs)
      .str();
}

std::string state_json(const DesignStateRow& row) {
  return EventText("design")
      .add("design", row.design)
      .add("state", word_of(row.state))
      .add("iteration", row.iteration)
      .add("used", row.used)
      .add("best", row.best)
      .add("best_mean", row.best ? std::optional(row.best_mean) : std::nullopt)
      .add("reason", row.reason)
      .str();
}

std::string worker_json(const WorkerRow& row) {
  return EventText("worker")
      .add("worker", row.id)
      .add("state", row.state)
      .add("host", row.host)
      .add("pid", row.pid)
      .add("slots", row.slots)
      .add("done", row.done)
      .add("failed", row.failed)
      .str();
}

std::string failure_json(const EvaluationRow& row) {
  if (row.status == EvaluationStatus::Ok) return "";
  return EventText("failure")
      .add("candidate", row.key.candidate)
      .add("pair", row.key.pair)
      .add("attempt", row.attempt)
      .add("worker", row.worker)
      .str();
}

std::string conflict_json(const ConflictRow& row) {
  return EventText("conflict")
      .add("candidate", row.key.candidate)
      .add("pair", row.key.pair)
      .add("kept_score", row.kept_score)
      .add("other_score", row.other_score)
      .add("worker", row.other_worker)
      .str();
}

std::string command_json(const CommandRow& row) {
  return EventText("command")
      .add("number", row.number)
      .add("kind", word_of(row.kind))
      .add("design", row.design)
      .raw("step", row.step ? std::to_string(*row.step) : "null")
      .raw("budget", row.kind == CommandKind::Extend ? std::to_string(row.budget) : "null")
      .add("who", row.who)
      .str();
}

std::string event_row_json(const EventRow& row) {
  return EventText("event")
      .add("severity", row.severity)
      .add("kind", row.kind)
      .raw("data", row.text.empty() ? "{}" : row.text)
      .str();
}

}  // namespace

std::string event_json(const Row& row) {
  const auto no_event = [](const auto&) { return std::string(); };
  return std::visit(
      Overloaded{[](const IterationRow& iteration) { return iteration_json(iteration); },
                 [](const RaceStepRow& step) { return step_json(step); },
                 [](const EliteRow& elite) { return elite_json(elite); },
                 [](const DesignStateRow& state) { return state_json(state); },
                 [](const WorkerRow& worker) { return worker_json(worker); },
                 [](const EvaluationRow& evaluation) { return failure_json(evaluation); },
                 [](const ConflictRow& conflict) { return conflict_json(conflict); },
                 [](const EventRow& event) { return event_row_json(event); },
                 [](const CampaignStateRow& campaign) {
                   return EventText("campaign").add("state", campaign.state).str();
                 },
                 [&](const CandidateRow& row_) { return no_event(row_); },
                 [&](const FailureRow& row_) { return no_event(row_); },
                 [&](const PairRow& row_) { return no_event(row_); },
                 [&](const UnusedRow& row_) { return no_event(row_); },
                 [&](const EliminationRow& row_) { return no_event(row_); },
                 [&](const CandidateTotalsRow& row_) { return no_event(row_); },
                 [&](const AttemptRow& row_) { return no_event(row_); },
                 [](const CommandRow& command) { return command_json(command); }},
      row);
}

std::string of_campaign(std::string event, const std::string& name) {
  // An event is an object.
  if (!name.empty()) event.insert(event.size() - 1, ",\"campaign\":" + json_text(name));
  return event;
}

std::string progress_json(const ProgressModel& model, const LiveStatus& live, std::int64_t left) {
  const bool known = live.evaluations_per_s > 0;
  return EventText("progress")
      .add("designs", model.designs())
      .add("designs_finished", model.finished())
      .add("used", model.used())
      .add("budget", model.budget())
      .add("workers", live.workers)
      .add("slots", live.slots)
      .add("leased", live.leased)
      .add("done", live.done)
      .add("rate", live.evaluations_per_s)
      .add("eta_s",
           known ? std::optional(static_cast<double>(left) / live.evaluations_per_s) : std::nullopt)
      .add("failed", live.failed)
      .add("rejected", live.rejected)
      .add("requeued", live.requeued)
      .add("expired", live.expired)
      .add("lost_workers", live.lost_workers)
      .add("duplicates", live.duplicates)
      .add("conflicts", live.conflicts)
      .add("unleased", live.unleased)
      .add("malformed", live.malformed)
      .add("trouble", live.trouble)
      .add("launcher", live.launcher.name.empty() ? "" : to_text(live.launcher))
      .str();
}

}  // namespace swarmsmith::cli
