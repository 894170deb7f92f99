#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "sim/engine/profile.h"

namespace swarmsmith {

/// Simulator profiles as TOML (docs/profiles.md). The built-in ones are files, too, which the
/// program carries: `rvr` (thesis 4.2: noise on), `argos3` (as the published files: noise off),
/// `pseudo-reality` (thesis 7.1), `thesis-robots` (the published programs of the robots), and for
/// the e-puck `epuck` (as published), `epuck-ideal` (noise off) and `epuck-pseudo-reality`.

std::vector<std::string> profile_names();

/// An unknown name is an error that lists the known ones.
Expected<Profile> built_in_profile(std::string_view name);

/// The file of a built-in profile, comments included; empty for an unknown name.
std::string_view built_in_profile_text(std::string_view name);

/// A profile, or everything that is wrong with its file: `where` is file:line:column.
using ProfileOrErrors = tl::expected<Profile, std::vector<Error>>;

/// `word` is the name of a built-in profile, or a file: what ends in .toml, or has a slash;
/// relative to `folder`.
ProfileOrErrors find_profile(const std::string& word, const std::filesystem::path& folder);

/// A profile as the text of a file; `file` gives its name (a profile has the name of its file,
/// without the ending) and is not read.
ProfileOrErrors parse_profile(std::string_view text, const std::filesystem::path& file);

/// All fields as a file of the profile's name. It reads back to the same profile.
std::string profile_text(const Profile& profile);

/// The keys of a profile in a table of another file, `name` among them. What is wrong goes to the
/// table's complaints.
Profile read_profile_table(TableReader& table);

/// All fields as lines; `header` is the name of the table they are in, "simulator.profile", which
/// may be one of a list of tables.
std::vector<Section> profile_sections(const Profile& profile, const std::string& header,
                                      bool in_list = false);

}  // namespace swarmsmith
