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

/// What a log does not say.
struct IraceImport {
  std::string campaign;  ///< name of the campaign that it becomes
  std::string mission = "tuning";
  std::string method = "irace";
  /// The configurations are machines in this flavour's grammar; nothing: parameters of a program.
  std::optional<Flavour> flavour;
  std::vector<KnownDesign> designs;  ///< that the store has
};

/// The log as a campaign of one design with the state "imported". Scores are negative costs. What
/// the log keeps silent about is worked out from its runs: who was alive on a pair is who has a
/// cost there, who leaves is who is not on the next one, best is who has the largest mean in the
/// race. Its tests' statistics are not known, nor why one was dropped: markers are `?`. Errors: a
/// configuration that is not a machine of the flavour.
OrErrors<Addition> irace_log_addition(const IraceLog& log, const IraceImport& known);

}  // namespace swarmsmith
