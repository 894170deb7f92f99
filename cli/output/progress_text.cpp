#include "cli/output/progress_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "base/plain_text.h"
#include "cli/output/number_text.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
namespace {

/// Pads the text on the left.
std::string right(const std::string& text, std::size_t width) {
  return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

/// There are no statistics before the first test; irace writes NA.
std::string optional_text(const std::optional<double>& value, const char* format) {
  if (!value) return "NA";
  char buffer[64];
  const int size = std::snprintf(buffer, sizeof buffer, format, *value);
  return {buffer, static_cast<std::size_t>(size)};
}

/// A bar that shows the used part of the whole budget.
std::string bar(std::int64_t used, std::int64_t budget) {
  constexpr std::int64_t kCells = 20;
  const std::int64_t filled = std::clamp<std::int64_t>(used * kCells / budget, 0, kCells);
  return "[" + std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kCells - filled), '-') + "]";
}

/// "1 200/3 000"; "1 200" if the budget is a time.
std::string spent(std::int64_t used, std::int64_t budget) {
  return grouped(used) + (budget > 0 ? "/" + grouped(budget) : "");
}

/// Sums over all campaigns, and the number of finished ones.
struct Totals : CampaignTotals {
  explicit Totals(std::span<const ProgressModel> models) {
    for (const ProgressModel& model : models) {
      over += model.totals().are_over();
      for (const auto& [id, progress] : model.by_design())
        add(progress);
    }
  }
  std::int64_t over = 0;
};

/// A part of a status line. If the line is too narrow, the least important parts are left out.
struct Piece {
  int rank;  ///< 1: most important
  std::string text;
};

/// The parts, in the order of the line.
std::vector<Piece> pieces_of(std::span<const ProgressModel> models, const LiveStatus& live) {
  const Totals totals(models);
  std::vector<Piece> pieces;
  const bool several = models.size() > 1;
  const DesignProgress* current = several ? nullptr : models.front().current();
  if (several) {
    pieces.push_back(
        {5, "campaigns " + std::to_string(totals.over) + "/" + std::to_string(models.size())});
  }
  pieces.push_back(
      {6, "designs " + std::to_string(totals.finished) + "/" + std::to_string(totals.designs)});
  const std::string stage = current != nullptr ? stage_of(*current) : "";
  if (!stage.empty()) {
    pieces.push_back({8, to_string(current->id) + " " + stage});
  } else if (current != nullptr && current->iteration > 0) {
    pieces.push_back({8, to_string(current->id) + " iteration " +
                             std::to_string(current->iteration) + "/~" +
                             std::to_string(std::max(current->iterations, current->iteration))});
  }
  // Counts the current step, too, because a step with many or slow candidates may take minutes.
  if (totals.budget > 0)
    pieces.push_back({9, bar(totals.budget - totals.left + totals.in_step, totals.budget)});
  pieces.push_back({2, spent(totals.used + totals.in_step, totals.budget)});
  if (current != nullptr && current->best) {
    pieces.push_back({4, (models.front().shows_costs() ? "best cost " : "best ") +
                             mean_text(models.front(), current->best_mean)});
  }
  if (const double left = seconds_left(live); left > 0)
    pieces.push_back({3, "ETA " + duration_text(left)});
  pieces.push_back({7, std::to_string(std::llround(live.evaluations_per_s)) + " sim/s"});
  // If there is a text for the stage, it already has these numbers.
  if (current != nullptr && current->configurations > 0 && stage.empty()) {
    pieces.push_back({10, "alive " + std::to_string(current->alive) + "/" +
                              std::to_string(current->configurations)});
  }
  if (totals.paused > 0) pieces.push_back({1, "paused " + std::to_string(totals.paused)});
  if (live.failed > 0) pieces.push_back({1, "failed " + std::to_string(live.failed)});
  if (live.workers > 0 || totals.over == static_cast<std::int64_t>(models.size())) return pieces;
  // Only local workers are available at once.
  const bool waits = !live.launcher.name.empty() && live.launcher.name != "local";
  pieces.push_back(
      {1, waits ? "no workers yet (" + to_text(live.launcher) + ")" : std::string("no workers")});
  return pieces;
}

std::string joined(const std::vector<Piece>& pieces) {
  std::string line;
  for (const Piece& piece : pieces)
    line += (line.empty() ? "" : "  ") + piece.text;
  return line;
}

}  // namespace

std::string score_text(double score) {
  char buffer[64];
  const int size =
      std::snprintf(buffer, sizeof buffer, std::abs(score) < 1000 ? "%.4g" : "%.0f", score);
  return {buffer, static_cast<std::size_t>(size)};
}

std::string mean_text(const ProgressModel& model, double score) {
  return score_text(model.shows_costs() ? to_cost(score) : score);
}

std::string best_text(const ProgressModel& model, const DesignStateRow& state) {
  const DesignProgress& design = model.design(state.design);
  if (!design.is_tested()) return mean_text(model, state.best_mean);
  return mean_text(model, design.test_mean) + " in " + std::to_string(design.test_runs) +
         (design.test_runs == 1 ? " test" : " tests");
}

std::string status_line(std::span<const ProgressModel> models, const LiveStatus& live,
                        std::size_t width) {
  std::vector<Piece> pieces = pieces_of(models, live);
  std::string line = joined(pieces);
  while (line.size() > width && pieces.size() > 1) {
    pieces.erase(std::ranges::max_element(pieces, {}, &Piece::rank));
    line = joined(pieces);
  }
  if (line.size() > width) line.resize(width);
  return line;
}

std::string plain_status(std::span<const ProgressModel> models, const LiveStatus& live) {
  std::vector<Piece> pieces = pieces_of(models, live);
  std::erase_if(pieces, [](const Piece& piece) { return piece.text.starts_with("["); });
  const std::string line = joined(pieces);
  if (Totals(models).over == static_cast<std::int64_t>(models.size())) return line;
  // Evaluations that wait at a worker for a slot are leased, too.
  return line + "  workers " + std::to_string(live.workers) + "  slots " +
         std::to_string(std::min(live.leased, live.slots)) + "/" + std::to_string(live.slots);
}

std::string race_headline() {
  return "design| |  pair|alive|      best|mean best|exp used| W time |  rho|KenW|  Qvar|";
}

std::string race_line(const RaceStepRow& step, const std::string& mean_best, double elapsed_s) {
  return right(to_string(step.design), 6) + "|" + step.marker + "|" +
         right(std::to_string(step.pair), 6) + "|" + right(std::to_string(step.alive_after), 5) +
         "|" + right(to_string(step.best), 10) + "|" + right(mean_best, 9) + "|" +
         right(std::to_string(step.used), 8) + "|" + clock_text(elapsed_s) + "|" +
         right(optional_text(step.spearman_rho, "%+.2f"), 5) + "|" +
         right(optional_text(step.kendall_w, "%.2f"), 4) + "|" +
         right(optional_text(step.qvar, "%.4f"), 6) + "|";
}

bool has_tests(const DesignProgress& progress) {
  return !progress.options || words_of(*progress.options).has_tests;
}

std::string iteration_line(const IterationRow& iteration, const DesignProgress& progress) {
  if (progress.options)
    return to_string(iteration.design) + " " + round_line(*progress.options, point_of(progress));
  return to_string(iteration.design) + " iteration " + std::to_string(iteration.number) + "/~" +
         std::to_string(std::max(iteration.of, iteration.number)) + ": " +
         counted(iteration.configurations, "configuration") + " (" +
         counted(iteration.elites, "elite") + "), budget " + grouped(iteration.budget) +
         (iteration.soft_restart ? ", soft restart" : "");
}

std::string elite_line(const EliteRow& elite, const DesignProgress& progress,
                       const std::string& mean) {
  if (!has_tests(progress)) {
    return to_string(elite.design) + " " + round_name(*progress.options, point_of(progress)) +
           ": best " + to_string(elite.candidate) + ", mean " + mean + " over " +
           counted(elite.runs, "run");
  }
  return to_string(elite.design) + " elite " + std::to_string(elite.rank) + ": " +
         to_string(elite.candidate) + "  mean " + mean + " over " + counted(elite.runs, "run");
}

std::string state_line(const DesignStateRow& state, const DesignProgress& progress,
                       const std::string& best_mean) {
  std::string text = to_string(state.design) + " " +
                     std::string(shown_state(progress, state.state)) + "  " + progress.mission +
                     " " + progress.method + " " + std::to_string(progress.repetition);
  // A design without a budget has no race.
  if (progress.budget > 0 || state.used > 0) {
    text += "  " + spent(state.used, progress.budget);
  }
  if (state.best && state.used > 0) text += "  best " + to_string(state.best) + " " + best_mean;
  // A race that ends because its budget is used has ended normally.
  const bool as_it_should =
      state.best && (state.reason.starts_with("not enough") ||
                     (progress.options && (state.reason == "the budget is used" ||
                                           state.reason == "limit of iterations")));
  if (!state.reason.empty() && !as_it_should) text += "  (" + state.reason + ")";
  return text;
}

std::string command_line(const CommandRow& command) {
  std::string text = std::string(word_of(command.kind)) + " " + to_string(command.design);
  if (command.kind == CommandKind::Extend)
    text +=
        " by " + grouped(command.budget) + (command.budget == 1 ? " experiment" : " experiments");
  if (!command.who.empty()) text += ", asked by " + command.who;
  // A command's row comes twice: when the user gives it, and when it takes effect.
  if (command.step) text += ": done after step " + std::to_string(*command.step);
  return text;
}

std::string event_line(const EventRow& event) {
  return event.severity + ": " + event.kind + (event.text.empty() ? "" : " " + event.text);
}

}  // namespace swarmsmith::cli
