#include "irace_core/search/evolution.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/assert.h"
#include "base/text/toml_text.h"
#include "irace_core/search/generations.h"
#include "irace_core/search/real_box.h"

namespace swarmsmith::search {
namespace {

/// With a random number below the first share a weight stays, below the second it is replaced,
/// otherwise the change is added to it.
struct Shares {
  double kept = 0;
  double replaced = 0;
};

/// NEAT's mutation of weights (NEAT 1.2.1; docs/methods.md, `evolution`): half of the genomes
/// change severely; in the other half, the last fifth of the weights changes more than the rest.
void mutate_neat(std::vector<double>& weights, double step, Rng& rng) {
  constexpr Shares kSevere{0.1, 0.3};
  constexpr Shares kTail{0.3, 0.5};
  constexpr std::size_t kLeastWithTail = 10;
  constexpr double kTailBegins = 0.8;
  const bool is_severe = rng.bernoulli(0.5);
  const double tail = kTailBegins * static_cast<double>(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double change = rng.uniform(-step, step);
    const double choice = rng.uniform();
    Shares shares;
    if (is_severe) {
      shares = kSevere;
    } else if (weights.size() >= kLeastWithTail && static_cast<double>(i) > tail) {
      shares = kTail;
    }
    if (choice < shares.kept) continue;
    weights[i] = choice < shares.replaced ? change : weights[i] + change;
  }
}

class EvolutionBreeder final : public Breeder {
 public:
  EvolutionBreeder(RealBox box, Rng rng, const EvolutionOptions& options,
                   std::vector<Configuration> initial)
      : box_(std::move(box)), rng_(rng), options_(options), initial_(std::move(initial)) {}

  Expected<Brood> breed(std::int64_t generation, std::int64_t size, std::int64_t next_id,
                        std::span<const Scored> last) override {
    Rng rng = rng_.split("evolution", static_cast<std::uint64_t>(generation));
    return last.empty() ? first(size, next_id, rng) : next(size, next_id, last, rng);
  }

  /// Breeds the generation after the last one. The members are restored, so that an extension
  /// continues from the last generation.
  Expected<Brood> finalists(std::int64_t count, std::int64_t next_id,
                            std::span<const Scored> last) override {
    Rng rng = rng_.split("evolution, final stage", static_cast<std::uint64_t>(next_id));
    const auto members = members_;
    Brood brood = next(count, next_id, last, rng);
    members_ = members;
    return brood;
  }

  std::vector<Scored> elites(std::span<const Scored> generation) override {
    const auto parents = generation.first(count_of(options_.parents, generation.size()));
    return {parents.begin(), parents.end()};
  }

  void add_to(Digest& digest) const override {
    for (const auto& [id, weights] : members_) {
      digest.add(id);
      for (const double weight : weights)
        digest.add(weight);
    }
  }

 private:
  static std::size_t count_of(double share, std::size_t population) {
    const auto count =
        static_cast<std::size_t>(std::floor(share * static_cast<double>(population)));
    return std::clamp<std::size_t>(count, 1, population);
  }

  /// The configurations that the user gave come first; the others have weights in [-1, 1].
  Brood first(std::int64_t size, std::int64_t next_id, Rng& rng) {
    Brood brood;
    for (std::int64_t i = 0; i < size; ++i) {
      std::vector<double> weights(box_.dimensions());
      for (double& weight : weights)
        weight = rng.uniform(-1, 1);
      const auto given = static_cast<std::size_t>(i);
      if (given < initial_.size()) weights = box_.to_point(initial_[given]);
      add(std::move(weights), 0, next_id, brood);
    }
    return brood;
  }

  /// The elites stay unchanged, and are run again with their children, on the same pairs; all
  /// others are mutated children of parents drawn uniformly, without crossover, as in EvoStick
  /// (docs/methods.md).
  Brood next(std::int64_t size, std::int64_t next_id, std::span<const Scored> last, Rng& rng) {
    const std::size_t parents = count_of(options_.parents, last.size());
    const std::size_t elites = std::min(parents, count_of(options_.elites, last.size()));
    SWARMSMITH_ASSERT(1 <= elites && elites <= parents && parents <= last.size(),
                      "every elite is a parent and was run");
    Brood brood;
    std::map<std::int64_t, std::vector<double>> before = std::exchange(members_, {});
    for (const Scored& elite : last.first(elites)) {
      brood.known.push_back(elite.id);
      members_.emplace(elite.id, before.at(elite.id));
    }
    while (static_cast<std::int64_t>(members_.size()) < size) {
      const std::int64_t parent = last[rng.below(parents)].id;
      std::vector<double> weights = before.at(parent);
      mutate(weights, options_.mutation, options_.step, rng);
      add(std::move(weights), parent, next_id, brood);
    }
    SWARMSMITH_ASSERT(brood.known.size() + brood.newcomers.size() == members_.size(),
                      "each member is an elite or new");
    return brood;
  }

  /// The search continues with the rounded weights.
  void add(std::vector<double> weights, std::int64_t parent, std::int64_t next_id, Brood& brood) {
    Configuration configuration = box_.to_configuration(weights);
    members_.emplace(next_id + static_cast<std::int64_t>(brood.newcomers.size()),
                     box_.to_point(configuration));
    brood.newcomers.push_back({std::move(configuration), parent});
  }

  RealBox box_;
  Rng rng_;
  EvolutionOptions options_;
  std::vector<Configuration> initial_;
  std::map<std::int64_t, std::vector<double>> members_;  ///< weights of the generation, by id
};

}  // namespace

void mutate(std::vector<double>& weights, Mutation mutation, double step, Rng& rng) {
  if (mutation == Mutation::Neat) {
    mutate_neat(weights, step, rng);
  } else {
    for (double& weight : weights)
      weight += rng.normal(0, step);
  }
  for (double& weight : weights)
    weight = std::clamp(weight, -RealBox::kHalfWidth, RealBox::kHalfWidth);
}

}  // namespace swarmsmith::search

namespace swarmsmith {

std::vector<SearchFault> EvolutionOptions::faults() const {
  if (elites <= parents) return {};
  return {{{"elites", "parents"},
           "`elites` (" + number_text(elites) + ") must be at most `parents` (" +
               number_text(parents) + "): each elite is also a parent"}};
}

Expected<std::unique_ptr<search::Strategy>> EvolutionOptions::start(search::Start from) const {
  auto box = search::RealBox::of(from.space, kWords.name);
  if (!box) return Unexpected(box.error());
  const auto plan =
      search::plan_generations(from.scenario.max_experiments, population, runs, final_runs);
  if (!plan) return Unexpected(plan.error());
  return std::make_unique<search::Generations>(
      *plan, std::make_unique<search::EvolutionBreeder>(std::move(*box), Rng(from.scenario.seed),
                                                        *this, std::move(from.initial)));
}

SearchPoint EvolutionOptions::planned(SearchPoint point) const {
  return search::planned_by(search::plan_generations(point.budget, population, runs, final_runs),
                            point);
}

}  // namespace swarmsmith
