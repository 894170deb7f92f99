#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// Flavours as TOML (docs/flavours.md). The built-in ones are files, too, which the program carries
/// (sim/control/flavours). They are read here, below the simulator's files, since robots and stores
/// need them as well.

/// Of those that are built in, in the order of `all_flavours`.
std::vector<std::string> flavour_names();

/// The file of a built-in flavour, comments included; empty for an unknown name.
std::string_view built_in_flavour_text(std::string_view name);

/// A flavour, or everything that is wrong with its file: `where` is file:line:column.
using FlavourOrErrors = tl::expected<Flavour, std::vector<Error>>;

/// `word` is the name of a built-in flavour, or a file: what ends in .toml, or has a slash;
/// relative to `folder`.
FlavourOrErrors find_flavour_file(const std::string& word, const std::filesystem::path& folder);

/// A flavour as the text of a file; `file` gives its name (a flavour has the name of its file,
/// without the ending) and is not read.
FlavourOrErrors parse_flavour(std::string_view text, const std::filesystem::path& file);

/// The keys of a flavour in a table of another file, `name` among them. What is wrong goes to the
/// table's complaints.
Flavour read_flavour_table(TableReader& table);

/// All of a flavour as lines; `header` is the name of the table that they are in, "method.flavour".
std::vector<Section> flavour_sections(const Flavour& flavour, const std::string& header);

/// All of it as a file that parse_flavour reads back.
std::string flavour_text(const Flavour& flavour);

/// The flavours of one's own that the [[method]] tables of a campaign's text have, as stores keep
/// it; what cannot be read is left out.
std::vector<const Flavour*> own_flavours_in(std::string_view campaign);

/// Whether the flavour is a built-in one: then its name says all of it.
bool is_built_in(const Flavour& flavour);

/// The same text for a flavour of one's own; empty for a built-in one, whatever its turn clock.
std::string own_flavour_text(const Flavour& flavour);

}  // namespace swarmsmith
