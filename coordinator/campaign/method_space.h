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

/// The space that a method searches: machines, trees or networks of a flavour, or the space of a
/// parameter file. A value; keep it as long as its configurations are used.
class MethodSpace {
 public:
  /// `digits`: decimals of the real parameters of machines; a parameter file sets its own. `aclib`:
  /// programs are called by AClib's convention. For errors in a parameter or configurations file,
  /// `where` contains line and column.
  static Expected<MethodSpace> make(const Method& method, int digits, bool aclib = false);

  const ParameterSpace& parameters() const;
  /// The configurations with which the first race begins.
  const std::vector<Configuration>& initial() const { return initial_; }

  CandidateText text_of(const Configuration& configuration) const;
  /// The control software of a configuration; not for the space of a parameter file.
  Controller controller_of(const Configuration& configuration) const;
  /// The changes that annealing makes; none if it changes one parameter at a time.
  std::optional<search::Neighbourhood> neighbourhood() const;

 private:
  MethodSpace() = default;

  std::shared_ptr<const MachineSpace> machines_;  ///< at most one of these two
  std::shared_ptr<const TreeSpace> trees_;
  std::optional<ParameterSpace> parameters_;  ///< for networks and parameter files
  Method method_;
  const Flavour* flavour_ = nullptr;  ///< null for a parameter file
  bool aclib_ = false;
  std::vector<Configuration> initial_;
};

/// The texts that the store keeps of control software that is not a configuration of a space. It
/// has no parameters.
CandidateText text_of(const Controller& controller, const Flavour& flavour);

/// The race options of a design on this mission, without its seed: with the number of instances,
/// and with the options that follow from the kind of evaluation (simulator or programs).
Scenario race_on(const Campaign& campaign, const CampaignMission& mission);

}  // namespace swarmsmith
