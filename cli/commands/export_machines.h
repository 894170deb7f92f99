#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/id.h"
#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// Machines as pictures, and as experiment files of the original simulator.
struct MachineExport {
  std::string format;  ///< svg, pdf, dot, tikz or argos
  std::string width;   ///< of a picture, as typed; empty: 84mm
  std::int64_t seed = 1;
  std::string place;  ///< a file, or a folder for several machines; empty: standard output
};

/// Writes each candidate's machine in that form, in this order. A file in a folder is called after
/// design and candidate: `d1-c812.svg`.
ExitCode export_machines(StoreReader& store, const std::vector<CandidateId>& candidates,
                         const MachineExport& what, Output& output);

}  // namespace swarmsmith::cli
