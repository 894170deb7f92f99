#pragma once

#include <string>
#include <vector>

#include "base/text/table_reader.h"
#include "coordinator/campaign/campaign.h"
#include "coordinator/campaign/internal/sections.h"

namespace swarmsmith {

/// What a method searches and how: `method` (a preset), `architecture`, `search`, and their tables.
/// Presets are names for a pair: only the pair is kept, so that both ways to write it are one
/// campaign.

/// Reads all of it but for what machines and trees are made of. `is_file`: the space is a parameter
/// file's, which has no architecture.
void read_search(TableReader& table, Method& method, bool is_file);

/// Keys of [[method]] for what is not an iterated race of machines.
std::vector<SectionLine> search_lines(const Method& method);
/// [method.network] and the table of the search, where they are used.
std::vector<Section> search_sections(const Method& method, const std::string& prefix);

}  // namespace swarmsmith
