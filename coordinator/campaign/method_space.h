#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/expected.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/candidate_text.h"
#include "coordinator/campaign/machine_space.h"
#include "coordinator/campaign/tree_space.h"
#include "irace_core/configuration.h"
#include "irace_core/parameter_space.h"
#include "irace_core/search/annealing.h"
#include "sim/control/controller.h"

namespace swarmsmith {

/// What a method searches: machines, trees or networks of a flavour, or the space of a parameter
/// file. A value that is kept as long as its configurations mean something.
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
  /// The control software of a configuration; not of a parameter file's space.
  Controller controller_of(const Configuration& configuration) const;
  /// What annealing changes; nothing where it changes one parameter at a time.
  std::optional<search::Neighbourhood> neighbourhood() const;

 private:
  MethodSpace() = default;

  std::shared_ptr<const MachineSpace> machines_;  ///< at most one of these two
  std::shared_ptr<const TreeSpace> trees_;
  std::optional<ParameterSpace> parameters_;  ///< of networks and parameter files
  Method method_;
  const Flavour* flavour_ = nullptr;  ///< null for a parameter file
  bool aclib_ = false;
  std::vector<Configuration> initial_;
};

/// What the store says of control software that is not a configuration of a space. No parameters.
CandidateText text_of(const Controller& controller, const Flavour& flavour);

/// The race options of a design on this mission, without its seed: its number of instances, and
/// what follows from who evaluates.
Scenario race_on(const Campaign& campaign, const CampaignMission& mission);

}  // namespace swarmsmith
