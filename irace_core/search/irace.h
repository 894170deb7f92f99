#pragma once

#include <memory>
#include <vector>

#include "irace_core/search/search_parts.h"

namespace swarmsmith {

/// Iterated F-race (irace_core/iterated_race.h). It has no options of its own: it uses the
/// scenario.
struct IraceOptions {
  static constexpr SearchWords kWords{.name = "irace",
                                      .round = "iteration",
                                      .at_work = "racing",
                                      .where = "race",
                                      .candidate = "configuration",
                                      .has_tests = true};

  template <class Self, class Visitor>
  static void fields(Self& /*self*/, Visitor& /*visitor*/) {}
  Expected<std::unique_ptr<Search>> start_race(ParameterSpace space, const Scenario& scenario,
                                               std::vector<Configuration> initial,
                                               Repair repair) const;
  friend bool operator==(const IraceOptions&, const IraceOptions&) = default;
};

}  // namespace swarmsmith
