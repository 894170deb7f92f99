#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/id.h"
#include "console/exit_code.h"
#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// The formats of `export` that need more than a line per machine; one source file per format.

/// Exports machines as pictures, or as experiment files of the original simulator.
struct MachineExport {
  std::string format;  ///< svg, pdf, dot, tikz or argos
  std::string width;   ///< width of a picture, as typed; empty: 84mm
  std::int64_t seed = 1;
  std::string place;  ///< a file, or a folder if there are several machines; empty: standard output
};

/// Writes the machine of each candidate in that format, in this order. A file in a folder is named
/// after its design and candidate: `d1-c812.svg`.
ExitCode export_machines(StoreReader& store, const std::vector<CandidateId>& chosen,
                         const MachineExport& what, Output& output);

/// Arguments of `export --format irace`.
struct IraceExport {
  std::string design;         ///< d3; empty: the first design, if there is no choice
  std::string version = "4";  ///< or 3.5
};

/// Writes a folder in which irace can run a design of `source`, a campaign file or a store. Creates
/// the folder; does not overwrite files.
ExitCode export_irace(const std::string& source, const IraceExport& what, const std::string& folder,
                      Output& output);

/// `export --format rdata`: writes a design's race as a log of R's irace, made by R. If the place
/// is a folder (the name ends with /, or the folder exists), writes the tables of the log instead,
/// without R. `design` is written as `d3`; it may be empty if the store has only one design.
ExitCode export_rdata(StoreReader& store, const std::string& design, const std::string& place,
                      Output& output);

}  // namespace swarmsmith::cli
