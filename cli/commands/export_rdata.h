#pragma once

#include <string>

#include "console/output.h"
#include "storage/store.h"

namespace swarmsmith::cli {

/// `export --format rdata`: a design's race as the log of R's irace, made by R; into a folder (a
/// name that ends with /, or one that is there) its tables, without R. `design` as `d3`; may be
/// empty in a store of one.
ExitCode export_rdata(StoreReader& store, const std::string& design, const std::string& place,
                      Output& output);

}  // namespace swarmsmith::cli
