#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "cli/replay/recording.h"
#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Arguments of `replay` for a real run.
struct RealReplayWords {
  RealRunId id;
  std::optional<std::int64_t> beside;  ///< number of simulations, on the seeds 1, 2, ...
  std::string seeds;                   ///< or the seeds of the simulations
  RecordingArguments recording;
};

/// `replay r7`: scores the stored cycles again, and shows the run beside simulations.
ExitCode replay_real(std::unique_ptr<StoreReader> store, const RealReplayWords& words,
                     Output& output);

}  // namespace swarmsmith::cli
