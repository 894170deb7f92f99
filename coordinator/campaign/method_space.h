#pragma once

#include <optional>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/candidate_text.h"
#include "coordinator/campaign/machine_space.h"
#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"

namespace swarmsmith {

/// What a method searches: the machines of a flavour, or the space of a parameter file. A value
/// that is kept as long as its configurations mean something.
class MethodSpace {
 public:
  /// `digits`: decimals of the reals of machines; a parameter file has its own. `aclib`: programs
  /// are called by AClib's convention. Errors of a parameter or configurations file have line and
  /// column in `where`.
  static Expected<MethodSpace> make(const Method& method, int digits, bool aclib = false);

  const ParameterSpace& parameters() const;
  /// The configurations that the first race begins with.
  const std::vector<Configuration>& initial() const { return initial_; }

  CandidateText text_of(const Configuration& configuration) const;
  /// Null for a parameter file's space.
  const MachineSpace* machines() const { return machines_ ? &*machines_ : nullptr; }

 private:
  MethodSpace() = default;

  std::optional<MachineSpace> machines_;
  const Flavour* flavour_ = nullptr;
  std::optional<ParameterSpace> parameters_;
  bool aclib_ = false;
  std::vector<Configuration> initial_;
};

/// What the store says of a machine that is no configuration of a space: without parameters.
CandidateText text_of(const Machine& machine, const Flavour& flavour);

/// The race options of a design on this mission, without its seed: its number of instances, and
/// what follows from who evaluates.
Scenario race_on(const Campaign& campaign, const CampaignMission& mission);

}  // namespace swarmsmith
