#pragma once

#include <string>
#include <vector>

#include "base/text/table_reader.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/internal/sections.h"

namespace swarmsmith {

/// What a method searches and how: `method` (a preset), `architecture`, `search`, and their tables.
/// Presets are names for a pair of architecture and search: only the pair is kept, so that both
/// ways to write it give the same campaign.

/// Reads all of this except the modules and sizes of machines and trees. `is_file`: the space comes
/// from a parameter file, which has no architecture.
void read_search(TableReader& table, Method& method, bool is_file);

/// The keys of [[method]] for methods other than an iterated race of machines.
std::vector<SectionLine> search_lines(const Method& method);
/// [method.network] and the table of the search, if they are used.
std::vector<Section> search_sections(const Method& method, const std::string& prefix);

}  // namespace swarmsmith
