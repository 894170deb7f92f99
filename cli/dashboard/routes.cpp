#include "cli/dashboard/routes.h"

#include <algorithm>
#include <array>

#include "cli/dashboard/figure_answers.h"
#include "cli/dashboard/race_answers.h"
#include "cli/dashboard/run_answers.h"
#include "cli/dashboard/store_answers.h"

namespace swarmsmith::cli {
namespace {

constexpr std::array<Pattern, 18> kRoutes = {{
    {"", campaign_answer},
    {"events", events_answer},
    {"convergence", convergence_answer},
    {"designs/*", design_answer},
    {"designs/*/steps", steps_answer},
    {"designs/*/race", race_answer, true},
    {"designs/*/parameters", parameters_answer, true},
    {"candidates/*", candidate_answer},
    {"evaluations/*", evaluation_answer},
    {"runs/*/trajectory", trajectory_answer, true},
    {"runs/*/trajectory.csv", trajectory_csv_answer, true},
    {"figures/*", figure_answer, true},
    {"comparison/*", comparison_answer, true},
    {"scores", scores_answer},
    {"leaderboard", leaderboard_answer},
    {"modules", modules_answer},
    {"real-runs", real_runs_answer},
    {"views", views_answer},
}};

/// The id in the path if the path matches the pattern.
std::optional<std::string> fit(std::string_view pattern, std::string_view path) {
  std::string id;
  while (!pattern.empty() && !path.empty()) {
    const std::string_view wanted = next_part(pattern);
    const std::string_view part = next_part(path);
    if (wanted == "*") {
      id = part;
    } else if (wanted != part) {
      return std::nullopt;
    }
  }
  return pattern.empty() && path.empty() ? std::optional(id) : std::nullopt;
}

}  // namespace

std::string_view next_part(std::string_view& path) {
  const std::size_t slash = std::min(path.find('/'), path.size());
  const std::string_view part = path.substr(0, slash);
  path.remove_prefix(std::min(slash + 1, path.size()));
  return part;
}

std::optional<Routed> route_of(std::string_view path) {
  for (const Pattern& pattern : kRoutes) {
    if (auto id = fit(pattern.path, path)) return Routed{&pattern, std::move(*id)};
  }
  return std::nullopt;
}

std::optional<std::size_t> store_named(std::string_view name, std::size_t stores) {
  for (std::size_t i = 0; i < stores; ++i)
    if (name == "c" + std::to_string(i + 1)) return i;
  return std::nullopt;
}

std::optional<Act> act_of(std::string_view path, std::size_t stores) {
  if (!path.starts_with(kApi)) return std::nullopt;
  path.remove_prefix(kApi.size());
  const auto store = store_named(next_part(path), stores);
  if (!store) return std::nullopt;
  Act act{.store = *store};
  std::string_view word = next_part(path);
  if (word == "designs") {
    const auto design = id_from_text<DesignTag>(next_part(path));
    if (!design) return std::nullopt;
    act.design = *design;
    word = next_part(path);
  }
  if (!path.empty()) return std::nullopt;
  for (const CommandKind kind :
       {CommandKind::Pause, CommandKind::Resume, CommandKind::Cancel, CommandKind::Extend}) {
    const bool fits = act.design || is_of_leases(kind);
    if (fits && word == swarmsmith::word_of(kind)) {
      act.kind = kind;
      return act;
    }
  }
  return std::nullopt;
}

}  // namespace swarmsmith::cli
