#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "base/expected.h"
#include "base/hash.h"
#include "base/rng.h"
#include "irace_core/internal/distributions.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith::irace {

/// Standard deviation of a fresh model (irace facts, 6.1): in the parameter's own scale, for
/// logarithmic and dependent domains as a fraction of the domain; 0 for categorical ones.
double initial_sd(const ParameterSpace& space, std::size_t parameter);

/// How strongly an update moves the models: `fraction` is (i-1)/I, `shrink` is (1/N')^(1/d),
/// `most` caps probabilities at 0.2^(1/d), in elitist runs only.
struct UpdateStrength {
  double fraction;
  double shrink;
  double most;
};
UpdateStrength update_strength(std::int64_t iteration, std::int64_t iterations,
                               std::int64_t new_configurations, int variable_parameters,
                               bool elitist = true);

/// Moves probabilities towards the value that the elite has, and caps the largest.
void update_probabilities(std::span<double> probabilities, std::size_t chosen,
                          const UpdateStrength& strength);

/// A tenth of the way up to the largest probability, for all values.
void restart_probabilities(std::span<double> probabilities);
double restart_sd(double sd, double initial, std::int64_t new_configurations,
                  int variable_parameters);

/// Which of E elites, best first from 0, becomes a parent: the best with weight E, the last with 1.
std::size_t draw_parent(std::size_t elites, Rng& rng);

/// Where values of one parameter are drawn from.
struct ParameterModel {
  std::vector<double> probabilities;  ///< of a categorical parameter's values
  double sd = 0;
  double mean = 0;  ///< in the original scale; NaN while no elite of the line had a value
  std::optional<TruncatedNormal> distribution;  ///< made from both where the domain is constant
};

/// An elite, as far as models need it.
struct EliteLine {
  std::int64_t id;
  std::int64_t parent;  ///< 0 for none
  const Configuration* configuration;
};

/// The sampling models of the elites: one an elite and parameter (irace facts, 6 and 7).
class SamplingModels {
 public:
  explicit SamplingModels(const ParameterSpace& space) : space_(&space) {}

  bool empty() const { return models_.empty(); }
  bool owns(std::int64_t id) const { return models_.contains(id); }
  /// A fresh model for every elite of the first race.
  void initialise(std::span<const EliteLine> elites);
  /// Moves the model of every elite: its own, or a copy of its parent's, or, after a post-selection
  /// race, which takes configurations from anywhere, the last that either had, or else a fresh one.
  void update(std::span<const EliteLine> elites, const UpdateStrength& strength);
  /// Widens one model.
  void restart(std::int64_t id, std::int64_t new_configurations);
  /// A configuration from the model of an elite.
  Expected<Configuration> sample(std::int64_t elite, Rng& rng) const;
  /// 0 without models.
  std::uint64_t digest() const;

 private:
  using Model = std::vector<ParameterModel>;  ///< by parameter

  Model fresh_model(const Configuration& elite) const;
  /// What an elite's model is made from.
  Model source_of(const EliteLine& elite) const;
  void prepare(std::size_t parameter, ParameterModel& model) const;
  double draw(std::size_t parameter, const ParameterModel& model, const Interval& domain,
              Rng& rng) const;

  const ParameterSpace* space_;
  std::map<std::int64_t, Model> models_;
  std::map<std::int64_t, Model> former_;  ///< of those that are not elites any more
};

}  // namespace swarmsmith::irace
