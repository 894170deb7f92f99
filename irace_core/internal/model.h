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

/// Standard deviation of a fresh model (irace facts, 6.1): in the parameter's own scale; for
/// logarithmic and dependent domains as a fraction of the domain; 0 for categorical ones.
double initial_sd(const ParameterSpace& space, std::size_t parameter);

/// How strongly an update changes the models: `fraction` is (i-1)/I, `shrink` is (1/N')^(1/d);
/// `most` limits probabilities to 0.2^(1/d), in elitist runs only.
struct UpdateStrength {
  double fraction;
  double shrink;
  double most;
};
UpdateStrength update_strength(std::int64_t iteration, std::int64_t iterations,
                               std::int64_t new_configurations, int variable_parameters,
                               bool elitist = true);

/// Moves the probabilities towards the value that the elite has, and limits the largest one.
void update_probabilities(std::span<double> probabilities, std::size_t chosen,
                          const UpdateStrength& strength);

/// Moves every probability a tenth of the way up to the largest one.
void restart_probabilities(std::span<double> probabilities);
double restart_sd(double sd, double initial, std::int64_t new_configurations,
                  int variable_parameters);

/// Draws the elite that becomes a parent, from `elites` elites, best first from 0: the best has
/// weight `elites`, the last has weight 1.
std::size_t draw_parent(std::size_t elites, Rng& rng);

/// The distribution from which values of one parameter are drawn.
struct ParameterModel {
  std::vector<double> probabilities;  ///< of a categorical parameter's values
  double sd = 0;
  double mean = 0;  ///< in the original scale; NaN until an elite of this line has a value
  std::optional<TruncatedNormal> distribution;  ///< made from mean and sd if the domain is constant
};

/// The properties of an elite that the models need.
struct EliteLine {
  std::int64_t id;
  std::int64_t parent;  ///< 0 for none
  const Configuration* configuration;
};

/// The sampling models of the elites: one per elite and parameter (irace facts, 6 and 7).
class SamplingModels {
 public:
  explicit SamplingModels(const ParameterSpace& space) : space_(&space) {}

  bool empty() const { return models_.empty(); }
  bool owns(std::int64_t id) const { return models_.contains(id); }
  /// Makes a fresh model for every elite of the first race.
  void initialise(std::span<const EliteLine> elites);
  /// Updates the model of every elite. The update starts from the elite's own model, otherwise from
  /// its parent's, otherwise from a fresh one. Models of former elites are also used, since a
  /// post-selection race may take any configuration.
  void update(std::span<const EliteLine> elites, const UpdateStrength& strength);
  /// Widens the model of one elite.
  void restart(std::int64_t id, std::int64_t new_configurations);
  /// Samples a configuration from the model of an elite.
  Expected<Configuration> sample(std::int64_t elite, Rng& rng) const;
  /// The digest of all models; 0 without models.
  std::uint64_t digest() const;

 private:
  using Model = std::vector<ParameterModel>;  ///< by parameter

  Model fresh_model(const Configuration& elite) const;
  /// The model from which an elite's updated model is made.
  Model source_of(const EliteLine& elite) const;
  void prepare(std::size_t parameter, ParameterModel& model) const;
  double draw(std::size_t parameter, const ParameterModel& model, const Interval& domain,
              Rng& rng) const;

  const ParameterSpace* space_;
  std::map<std::int64_t, Model> models_;
  std::map<std::int64_t, Model> former_;  ///< models of configurations that are no longer elites
};

}  // namespace swarmsmith::irace
