#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/expected.h"
#include "coordinator/results/irace_log.h"
#include "coordinator/results/known_designs.h"
#include "sim/control/flavour.h"
#include "storage/store_at_rest.h"

namespace swarmsmith {

/// Information that a log does not contain.
struct IraceImport {
  std::string campaign;  ///< name of the imported campaign
  std::string mission = "tuning";
  std::string method = "irace";
  /// The flavour if the configurations are machines in its grammar; none: parameters of a program.
  std::optional<Flavour> flavour;
  std::vector<KnownDesign> designs;  ///< designs in the store
};

/// Converts the log to a campaign with one design and the state "imported". Scores are negative
/// costs. Information that the log lacks is derived from its runs: a configuration is alive on a
/// pair if it has a cost there; it is dropped if it has none on the next pair; the best one has the
/// largest mean in the race. The statistics of the race's tests and the reasons for dropping are
/// unknown, so markers are `?`. Errors: a configuration that is not a machine of the flavour.
OrErrors<Addition> irace_log_addition(const IraceLog& log, const IraceImport& known);

}  // namespace swarmsmith
