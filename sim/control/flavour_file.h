#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/text/table_reader.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// Flavours as TOML (docs/flavours.md). The built-in flavours are such files, too, embedded in the
/// program (sim/control/flavours). They are read here, below the simulator's files, because robots
/// and stores need them as well.

/// The names of the built-in flavours, in the order of `all_flavours`.
std::vector<std::string> flavour_names();

/// The file of a built-in flavour, comments included; empty for an unknown name.
std::string_view built_in_flavour_text(std::string_view name);

/// A flavour, or all errors in its file; `where` of each is file:line:column.
using FlavourOrErrors = tl::expected<Flavour, std::vector<Error>>;

/// `word` is the name of a built-in flavour or a file: a word that ends in .toml or contains a
/// slash is a file, relative to `folder`.
FlavourOrErrors find_flavour_file(const std::string& word, const std::filesystem::path& folder);

/// Parses a flavour from the text of a file. `file` only gives the names of the file and of the
/// flavour (the file name without its ending); it is not opened.
FlavourOrErrors parse_flavour(std::string_view text, const std::filesystem::path& file);

/// Reads the keys of a flavour, `name` included, from a table of another file. Errors are added to
/// the table's complaints.
Flavour read_flavour_table(TableReader& table);

/// The custom flavours in the [[method]] tables of a campaign's text, as stores keep it. Flavours
/// that cannot be read are left out.
std::vector<const Flavour*> own_flavours_in(std::string_view campaign);

/// Whether the flavour is a built-in one, so that its name describes it completely.
bool is_built_in(const Flavour& flavour);

/// The text of a custom flavour; empty for a built-in one, whatever its turn clock.
std::string own_flavour_text(const Flavour& flavour);

}  // namespace swarmsmith
