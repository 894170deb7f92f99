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
#include "sim/robot/robot.h"

namespace swarmsmith {

/// Simulator profiles as TOML (docs/profiles.md). The built-in profiles are such files, too,
/// embedded in the program: `rvr` (thesis 4.2: noise on), `argos3` (as in the published files:
/// noise off), `pseudo-reality` (thesis 7.1), `thesis-robots` (the published programs of the
/// robots), and for the e-puck `epuck` (as published), `epuck-ideal` (noise off) and
/// `epuck-pseudo-reality`.

std::vector<std::string> profile_names();

/// An unknown name is an error that lists the known ones.
Expected<Profile> built_in_profile(std::string_view name);

/// The names of the built-in profiles that fit the robot (`misfit` of sim/engine/fitting.h).
std::vector<std::string> profiles_of(const Robot& robot);

/// " (argos3, epuck)" with the profiles that fit the robot, for messages; empty if none fits.
std::string profiles_text(const Robot& robot);

/// The name of the robot's profile where a user names none: the first built-in robot's whose
/// profile fits; `rvr` if none fits.
std::string usual_profile(const Robot& robot);

/// The file of a built-in profile, comments included; empty for an unknown name.
std::string_view built_in_profile_text(std::string_view name);

/// A profile, or all errors in its file; `where` of each is file:line:column.
using ProfileOrErrors = tl::expected<Profile, std::vector<Error>>;

/// `word` is the name of a built-in profile or a file: a word that ends in .toml or contains a
/// slash is a file, relative to `folder`.
ProfileOrErrors find_profile(const std::string& word, const std::filesystem::path& folder);

/// Parses a profile from the text of a file. `file` only gives the names of the file and of the
/// profile (the file name without its ending); it is not opened.
ProfileOrErrors parse_profile(std::string_view text, const std::filesystem::path& file);

/// All fields as the text of a file with the profile's name. It reads back to the same profile.
std::string profile_text(const Profile& profile);

/// Reads the keys of a profile, `name` included, from a table of another file. Errors are added to
/// the table's complaints.
Profile read_profile_table(TableReader& table);

/// All fields as lines; `header` is the name of the table that holds them, such as
/// "simulator.profile", which may be one of a list of tables.
std::vector<Section> profile_sections(const Profile& profile, const std::string& header,
                                      bool in_list = false);

}  // namespace swarmsmith
