#include "coordinator/cli/progress_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "coordinator/cli/campaign_plan.h"

namespace swarmsmith::cli {
namespace {

/// Padded on the left.
std::string right(const std::string& text, std::size_t width) {
  return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

/// Statistics are not there before the first test; irace writes NA.
std::string optional_text(const std::optional<double>& value, const char* format) {
  if (!value) return "NA";
  char buffer[64];
  const int size = std::snprintf(buffer, sizeof buffer, format, *value);
  return {buffer, static_cast<std::size_t>(size)};
}

/// Hours may have more than two digits.
std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(seconds);
  char buffer[64];
  const int size = std::snprintf(buffer, sizeof buffer, "%02lld:%02lld:%02lld", whole / 3600,
                                 whole / 60 % 60, whole % 60);
  return {buffer, static_cast<std::size_t>(size)};
}

/// How much of the whole budget is used.
std::string bar(std::int64_t used, std::int64_t budget) {
  constexpr std::int64_t kCells = 20;
  const std::int64_t filled =
      budget > 0 ? std::clamp<std::int64_t>(used * kCells / budget, 0, kCells) : 0;
  return "[" + std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kCells - filled), '-') + "]";
}

/// Sums over what is told of.
struct Totals {
  explicit Totals(std::span<const ProgressModel> models) {
    for (const ProgressModel& model : models) {
      over += model.is_over();
      designs += model.designs();
      finished += model.finished();
      paused += model.paused();
      used += model.used();
      budget += model.budget();
    }
  }
  std::int64_t over = 0, designs = 0, finished = 0, paused = 0, used = 0, budget = 0;
};

/// What both status lines say before and after the bar.
std::string first_half(std::span<const ProgressModel> models, const Totals& totals) {
  const std::string designs =
      "designs " + std::to_string(totals.finished) + "/" + std::to_string(totals.designs);
  if (models.size() > 1) {
    return "campaigns " + std::to_string(totals.over) + "/" + std::to_string(models.size()) + "  " +
           designs;
  }
  const DesignProgress* current = models.front().current();
  if (current == nullptr || current->iteration == 0) return designs;
  return designs + "  " + to_string(current->design.id) + " iteration " +
         std::to_string(current->iteration) + "/~" +
         std::to_string(std::max(current->iterations, current->iteration));
}

/// Of the design that a campaign is at.
std::string race_text(const DesignProgress* current) {
  std::string text;
  if (current != nullptr && current->configurations > 0) {
    text +=
        "  alive " + std::to_string(current->alive) + "/" + std::to_string(current->configurations);
  }
  if (current != nullptr && current->best) text += "  best " + score_text(current->best_mean);
  return text;
}

/// Numbers, the most important first.
std::string second_half(std::span<const ProgressModel> models, const Totals& totals,
                        const LiveStatus& live) {
  std::string text = grouped(totals.used) + "/" + grouped(totals.budget);
  if (models.size() == 1) text += race_text(models.front().current());
  text += "  " + std::to_string(std::llround(live.evaluations_per_s)) + " sim/s";
  const auto left = static_cast<double>(totals.budget - totals.used);
  if (live.evaluations_per_s > 0 && left > 0) {
    text += "  ETA " + duration_text(left / live.evaluations_per_s);
  }
  if (totals.paused > 0) text += "  paused " + std::to_string(totals.paused);
  if (live.failed > 0) text += "  failed " + std::to_string(live.failed);
  if (live.workers > 0) return text;
  // Only local workers are there at once.
  const bool waits = !live.launcher.name.empty() && live.launcher.name != "local";
  text += waits ? "  no workers yet (" + to_text(live.launcher) + ")" : "  no workers";
  return text;
}

/// How irace says that it ends as it should reads like a fault.
std::string reason_text(const DesignStateRow& state) {
  const bool used_up = state.best && state.reason.starts_with("not enough");
  return used_up ? "budget used up: the rest is too little for another race" : state.reason;
}

}  // namespace

std::string score_text(double score) {
  char buffer[64];
  const int size =
      std::snprintf(buffer, sizeof buffer, std::abs(score) < 1000 ? "%.4g" : "%.0f", score);
  return {buffer, static_cast<std::size_t>(size)};
}

std::string_view name_of(DesignState state) {
  static constexpr std::array<std::string_view, 5> kNames = {"waiting", "racing", "testing",
                                                             "finished", "stopped"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string status_line(std::span<const ProgressModel> models, const LiveStatus& live,
                        std::size_t width) {
  const Totals totals(models);
  std::string line = first_half(models, totals) + "  " + bar(totals.used, totals.budget) + "  " +
                     second_half(models, totals, live);
  // Whatever is least needed stands last.
  if (line.size() > width) line.resize(width);
  return line;
}

std::string plain_status(std::span<const ProgressModel> models, const LiveStatus& live) {
  const Totals totals(models);
  return first_half(models, totals) + "  " + second_half(models, totals, live) + "  workers " +
         std::to_string(live.workers) + "  slots " + std::to_string(live.leased) + "/" +
         std::to_string(live.slots);
}

std::string race_headline() {
  return "design | |       pair|      alive|       best|       mean best| exp so far|  W time|  rho"
         "|KenW|  Qvar|";
}

std::string race_line(const RaceStepRow& step, double elapsed_s) {
  return right(to_string(step.design), 6) + " |" + step.marker + "|" +
         right(std::to_string(step.pair), 11) + "|" + right(std::to_string(step.alive_after), 11) +
         "|" + right(to_string(step.best), 11) + "|" + right(score_text(step.mean_best), 16) + "|" +
         right(std::to_string(step.used), 11) + "|" + clock_text(elapsed_s) + "|" +
         right(optional_text(step.spearman_rho, "%+.2f"), 5) + "|" +
         right(optional_text(step.kendall_w, "%.2f"), 4) + "|" +
         right(optional_text(step.qvar, "%.4f"), 6) + "|";
}

std::string iteration_line(const IterationRow& iteration, const DesignProgress& progress) {
  return to_string(iteration.design) + " " + progress.design.mission + " " +
         progress.design.method + " iteration " + std::to_string(iteration.number) + " of about " +
         std::to_string(iteration.of) + ": " + std::to_string(iteration.configurations) +
         " configurations (" + std::to_string(iteration.elites) + " elites), budget " +
         grouped(iteration.budget) + (iteration.soft_restart ? ", soft restart" : "");
}

std::string elite_line(const EliteRow& elite) {
  return to_string(elite.design) + " elite " + std::to_string(elite.rank) + ": " +
         to_string(elite.candidate) + "  mean " + score_text(elite.mean) + " over " +
         std::to_string(elite.runs) + " runs";
}

std::string state_line(const DesignStateRow& state, const DesignProgress& progress) {
  std::string text = to_string(state.design) + " " + progress.design.mission + " " +
                     progress.design.method + " repetition " +
                     std::to_string(progress.design.repetition) + " " +
                     std::string(name_of(state.state)) + "  used " + grouped(state.used) + "/" +
                     grouped(progress.design.budget);
  if (state.best) {
    text += "  best " + to_string(state.best) + " " + score_text(state.best_mean);
  }
  if (!state.reason.empty()) text += "  (" + reason_text(state) + ")";
  return text;
}

std::string command_line(const CommandRow& command) {
  std::string text = command.kind + " " + to_string(command.design);
  if (command.kind == "extend") text += " by " + grouped(command.budget) + " experiments";
  if (!command.who.empty()) text += ", asked by " + command.who;
  // Its row comes when it is asked for, and when it acts.
  if (command.step) text += ": done after step " + std::to_string(*command.step);
  return text;
}

std::string event_line(const EventRow& event) {
  return event.severity + ": " + event.kind + (event.text.empty() ? "" : " " + event.text);
}

}  // namespace swarmsmith::cli
