#include "irace_core/search/stage.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "base/plain_text.h"
#include "irace_core/search/annealing.h"
#include "irace_core/search/generations.h"
#include "irace_core/search/random_search.h"

namespace swarmsmith {
namespace {

std::string of(std::int64_t whole) {
  return whole > 0 ? " of " + std::to_string(whole) : "";
}

std::string range(std::string_view what, std::int64_t first, std::int64_t last) {
  const std::string begin = std::to_string(first);
  if (last < first) return std::string(what) + "s from " + begin + " on";
  return std::string(what) + "s " + begin + " to " + std::to_string(last);
}

/// Of the iteration's candidates, those that have been run: runs come pair by pair.
std::int64_t ready(const SearchPoint& point) {
  if (point.runs_wanted == 0) return 0;
  return std::min(point.configurations, point.runs * point.configurations / point.runs_wanted);
}

/// What an iteration's number leaves out: final stages.
std::int64_t number_of(const SearchPoint& point) {
  return point.iteration - point.finals;
}

std::int64_t planned_of(const SearchPoint& point) {
  return point.iterations > 0 ? point.iterations - point.finals - 1 : 0;
}

/// Of random search; one that was extended has another plan.
std::optional<search::GenerationPlan> draws(const SearchOptions& options,
                                            const SearchPoint& point) {
  if (point.finals > 0) return std::nullopt;
  const auto plan = search::plan_random_search(point.budget, options.random);
  return plan ? std::optional(*plan) : std::nullopt;
}

Expected<search::GenerationPlan> plan_of(const SearchOptions& options, std::int64_t budget) {
  if (options.kind == SearchKind::Random) return search::plan_random_search(budget, options.random);
  if (options.kind == SearchKind::Evolution) {
    return search::plan_generations(budget, options.evolution.population, options.evolution.runs,
                                    options.evolution.final_runs);
  }
  if (options.kind == SearchKind::CmaEs) {
    return search::plan_generations(budget, options.cma_es.population, options.cma_es.runs,
                                    options.cma_es.final_runs);
  }
  return bad_input("has no generations");
}

/// The point with what options and budget say, where no event has said it. A search that was
/// extended has another plan.
SearchPoint as_planned(const SearchOptions& options, SearchPoint point) {
  if (point.iterations > 0 || point.finals > 0) return point;
  if (options.kind == SearchKind::Annealing) {
    point.is_final =
        point.iteration > 1 && !search::walks_on(options.annealing, point.budget, point.used);
  } else if (const auto plan = plan_of(options, point.budget)) {
    point.iterations = plan->generations + 1;
    point.is_final = point.iteration > plan->generations;
  }
  return point;
}

std::string random_name(const SearchOptions& options, const SearchPoint& point) {
  const auto plan = draws(options, point);
  if (!plan) return "further configurations";
  const std::int64_t before = (point.iteration - 1) * plan->population;
  return range("configuration", before + 1,
               std::min(before + plan->population, plan->configurations));
}

std::string random_stage(const SearchOptions& options, const SearchPoint& point) {
  const auto plan = draws(options, point);
  if (!plan) return "further configurations";
  const std::int64_t before = (point.iteration - 1) * plan->population;
  return "configuration " + std::to_string(before + ready(point)) + of(plan->configurations);
}

/// Iterations of annealing that are over; the first steps are those of the scale.
std::int64_t walked(const SearchOptions& options, const SearchPoint& point) {
  return std::max<std::int64_t>(0, point.step - options.annealing.window);
}

std::string annealing_stage(const SearchOptions& options, const SearchPoint& point) {
  const std::int64_t number = walked(options, point) + 1;
  char temperature[32];
  std::snprintf(temperature, sizeof temperature, "%.3g",
                search::told_temperature(options.annealing, point.budget, point.used, number));
  // A continued campaign does not know its step before the next one.
  const std::string name = point.step > 0
                               ? "iteration " + std::to_string(number)
                               : std::string("an iteration of ") + round_name(options, point);
  return name + ", temperature " + temperature;
}

}  // namespace

std::string round_name(const SearchOptions& options, const SearchPoint& known) {
  const SearchPoint point = as_planned(options, known);
  if (options.kind == SearchKind::FRace) return "one race";
  if (point.is_final && !words_of(options.kind).has_tests) return "final stage";
  if (options.kind == SearchKind::Random) return random_name(options, point);
  if (options.kind == SearchKind::Annealing) {
    if (point.iteration <= 1) return "scale of the scores";
    const std::int64_t before = (point.iteration - 2) * search::kAnnealingBlock;
    const std::int64_t last = std::min(walked(options, point), before + search::kAnnealingBlock);
    return range("iteration", before + 1, last);
  }
  const SearchWords& words = words_of(options.kind);
  return std::string(words.round) + " " +
         std::to_string(words.has_tests ? point.iteration : number_of(point));
}

std::string round_line(const SearchOptions& options, const SearchPoint& known) {
  const SearchPoint point = as_planned(options, known);
  const SearchWords& words = words_of(options.kind);
  const std::string name = round_name(options, point);
  if (words.has_tests) {
    return name + ": " + counted(point.configurations, words.candidate) + ", budget " +
           std::to_string(point.runs_wanted);
  }
  const std::string each =
      counted(point.runs_wanted / std::max<std::int64_t>(1, point.configurations), "run") + " each";
  const std::string members = ": " + counted(point.configurations, words.candidate) + ", " + each;
  if (point.is_final) return name + members;
  if (options.kind == SearchKind::Random) {
    const auto plan = draws(options, point);
    return plan ? name + of(plan->configurations) + ": " + each : name + members;
  }
  // A walk does not know how many runs its iterations take.
  if (options.kind == SearchKind::Annealing) return point.iteration > 1 ? name : name + members;
  return name + of(planned_of(point)) + members;
}

std::string stage_text(const SearchOptions& options, const SearchPoint& known) {
  if (known.iteration == 0) return "";
  const SearchPoint point = as_planned(options, known);
  const SearchWords& words = words_of(options.kind);
  const std::string members =
      point.configurations > 0
          ? std::to_string(ready(point)) + " of " + counted(point.configurations, words.candidate)
          : "";
  if (point.is_final && !words.has_tests)
    return members.empty() ? "final stage" : "final stage: " + members;
  const std::string name = round_name(options, point);
  if (options.kind == SearchKind::FRace)
    return name + (point.alive > 0 ? ": " + std::to_string(point.alive) + " left" : "");
  if (words.has_tests) return name + of(point.iterations);
  if (options.kind == SearchKind::Random) return random_stage(options, point);
  if (options.kind == SearchKind::Annealing) {
    if (point.iteration > 1) return annealing_stage(options, point);
    return name + (members.empty() ? "" : ": " + members);
  }
  return name + of(planned_of(point)) + (ready(point) > 0 ? ", " + members : "");
}

}  // namespace swarmsmith
