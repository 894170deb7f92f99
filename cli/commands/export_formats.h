#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/id.h"
#include "console/exit_code.h"
#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The formats of `export` that are more than a line a machine, a file a format.

/// Machines as pictures, and as experiment files of the original simulator.
struct MachineExport {
  std::string format;  ///< svg, pdf, dot, tikz or argos
  std::string width;   ///< of a picture, as typed; empty: 84mm
  std::int64_t seed = 1;
  std::string place;  ///< a file, or a folder for several machines; empty: standard output
};

/// Writes each candidate's machine in that form, in this order. A file in a folder is called after
/// design and candidate: `d1-c812.svg`.
ExitCode export_machines(StoreReader& store, const std::vector<CandidateId>& chosen,
                         const MachineExport& what, Output& output);

/// Arguments of `export --format irace`.
struct IraceExport {
  std::string design;         ///< d3; empty: the first, when there is no choice
  std::string version = "4";  ///< or 3.5
};

/// Writes a folder in which irace does a design of `source`, a campaign file or a store. The folder
/// is made; files that are there already are not overwritten.
ExitCode export_irace(const std::string& source, const IraceExport& what, const std::string& folder,
                      Output& output);

/// `export --format rdata`: a design's race as the log of R's irace, made by R; into a folder (a
/// name that ends with /, or one that is there) its tables, without R. `design` as `d3`; may be
/// empty in a store of one.
ExitCode export_rdata(StoreReader& store, const std::string& design, const std::string& place,
                      Output& output);

}  // namespace swarmsmith::cli
