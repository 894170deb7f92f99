#include "irace_core/search/random.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "base/assert.h"
#include "base/plain_text.h"
#include "irace_core/internal/sampling.h"
#include "irace_core/search/generations.h"

namespace swarmsmith::search {
namespace {

/// Size of a chunk: enough for a cluster, and small enough to show progress.
constexpr std::int64_t kChunk = 1000;
/// One finalist per this number of runs of the budget.
constexpr std::int64_t kAutomaticFinalists = 1000;

class RandomBreeder final : public Breeder {
 public:
  RandomBreeder(const ParameterSpace& space, Rng rng, std::int64_t finalists,
                std::vector<Configuration> initial, Repair repair)
      : space_(space),
        rng_(rng),
        finalists_(static_cast<std::size_t>(finalists)),
        initial_(std::move(initial)),
        repair_(std::move(repair)) {}

  Expected<Brood> breed(std::int64_t, std::int64_t size, std::int64_t,
                        std::span<const Scored>) override {
    Brood brood;
    for (std::int64_t i = 0; i < size; ++i) {
      // Given configurations come first (docs/methods.md, "What does not go together"). They count
      // as draws.
      if (drawn_ < initial_.size()) {
        brood.newcomers.push_back({initial_[drawn_++], 0});
        continue;
      }
      // A stream for each draw: a larger budget begins with the same configurations.
      Rng rng = rng_.split("random", ++drawn_);
      auto drawn = draw_uniform(space_, repair_, rng);
      if (!drawn) return Unexpected(drawn.error());
      brood.newcomers.push_back({std::move(*drawn), 0});
    }
    return brood;
  }

  Expected<Brood> finalists(std::int64_t count, std::int64_t, std::span<const Scored>) override {
    SWARMSMITH_ASSERT(static_cast<std::int64_t>(best_.size()) == count, "finalists were run");
    Brood brood;
    for (const Scored& one : best_)
      brood.known.push_back(one.id);
    return brood;
  }

  /// The best of all chunks so far; all chunks are run on the same pairs.
  std::vector<Scored> elites(std::span<const Scored> chunk) override {
    // Means of different chunks can be compared, since the chunks share their pairs.
    best_.insert(best_.end(), chunk.begin(), chunk.end());
    std::ranges::sort(best_, [](const Scored& a, const Scored& b) {
      return a.mean != b.mean ? a.mean < b.mean : a.id < b.id;
    });
    if (best_.size() > finalists_) best_.resize(finalists_);
    return best_;
  }

  void add_to(Digest& digest) const override {
    digest.add(static_cast<std::uint64_t>(drawn_));
    for (const Scored& one : best_)
      digest.add(one.id);
  }

 private:
  const ParameterSpace& space_;
  Rng rng_;
  std::size_t finalists_;
  std::vector<Configuration> initial_;
  Repair repair_;
  std::size_t drawn_ = 0;
  std::vector<Scored> best_;
};

}  // namespace

Expected<Configuration> draw_uniform(const ParameterSpace& space, const Repair& repair, Rng& rng) {
  // As in irace (irace facts, 8.4).
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    auto drawn = sample_uniform(space, rng);
    if (!drawn) return drawn;
    // irace facts, 8.5: repair comes before the forbidden test.
    auto whole = irace::repaired(space, repair, std::move(*drawn));
    if (!whole || !space.is_forbidden(*whole)) return whole;
  }
  return bad_input(
      "a hundred draws in a row were forbidden: the forbidden clauses exclude too much");
}

Expected<GenerationPlan> plan_random_search(std::int64_t budget, const RandomOptions& options) {
  const bool is_automatic = options.finalists == 0;
  // There are at least as many draws as finalists.
  const std::int64_t each = options.runs + options.final_runs;
  const std::int64_t least = (is_automatic ? 1 : options.finalists) * each;
  if (budget < least) return Unexpected(too_small(budget, least));
  const std::int64_t finalists =
      // docs/methods.md: budget / 1,000, or as many as the budget can pay. Each needs its runs as a
      // draw and its final runs.
      is_automatic ? std::clamp<std::int64_t>(budget / kAutomaticFinalists, 1, budget / each)
                   : options.finalists;
  // The final stage is reserved first; all other runs go into draws.
  GenerationPlan plan{.population = kChunk,
                      .configurations = (budget - finalists * options.final_runs) / options.runs,
                      .runs = options.runs,
                      .fresh_pairs = false,
                      .finalists = finalists,
                      .final_runs = options.final_runs};
  plan.generations = (plan.configurations + kChunk - 1) / kChunk;
  SWARMSMITH_ASSERT(plan.configurations >= finalists, "a finalist was drawn");
  // The remaining runs are too few for a draw; finalists get further pairs from them.
  plan.final_runs = (budget - plan.configurations * plan.runs) / finalists;
  return plan;
}

}  // namespace swarmsmith::search

namespace swarmsmith {
namespace {

/// The plan of the search; nothing for a search that was extended, since it has another plan.
std::optional<search::GenerationPlan> draws(const RandomOptions& options,
                                            const SearchPoint& point) {
  if (point.finals > 0) return std::nullopt;
  const auto plan = search::plan_random_search(point.budget, options);
  return plan ? std::optional(*plan) : std::nullopt;
}

}  // namespace

Expected<std::unique_ptr<search::Strategy>> RandomOptions::start(search::Start from) const {
  const auto plan = search::plan_random_search(from.scenario.max_experiments, *this);
  if (!plan) return Unexpected(plan.error());
  return std::make_unique<search::Generations>(
      *plan,
      std::make_unique<search::RandomBreeder>(from.space, Rng(from.scenario.seed), plan->finalists,
                                              std::move(from.initial), std::move(from.repair)));
}

SearchPoint RandomOptions::planned(SearchPoint point) const {
  return search::planned_by(search::plan_random_search(point.budget, *this), point);
}

/// The parts of the search are chunks of draws; the texts count the draws.
StageTexts RandomOptions::texts(const SearchPoint& point) const {
  const auto plan = draws(*this, point);
  if (!plan) {
    StageTexts texts = usual_texts(kWords, point, "further configurations");
    texts.line = texts.name + ": " + counted(point.configurations, kWords.candidate) + ", " +
                 stage::each(point);
    texts.stage = texts.name;
    return texts;
  }
  const std::int64_t before = (point.iteration - 1) * plan->population;
  const std::string name = stage::range(kWords.candidate, before + 1,
                                        std::min(before + plan->population, plan->configurations));
  return {.name = name,
          .line = name + stage::of(plan->configurations) + ": " + stage::each(point),
          .stage = "configuration " + std::to_string(before + stage::ready(point)) +
                   stage::of(plan->configurations)};
}

}  // namespace swarmsmith
