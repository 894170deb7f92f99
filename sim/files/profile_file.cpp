#include "sim/files/profile_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/assert.h"
#include "base/suggestion.h"
#include "base/text/document.h"
#include "base/text/table_reader.h"
#include "base/text/whole_file.h"
#include "embedded/kArgos3Profile.h"
#include "embedded/kEpuckIdealProfile.h"
#include "embedded/kEpuckProfile.h"
#include "embedded/kEpuckPseudoRealityProfile.h"
#include "embedded/kPseudoRealityProfile.h"
#include "embedded/kRvrProfile.h"
#include "embedded/kThesisRobotsProfile.h"
#include "sim/control/toml_kind.h"
#include "sim/engine/fitting.h"
#include "sim/files/internal/read_profile.h"
#include "sim/files/mission_file.h"
#include "sim/files/robot_file.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kFiles = {
    {{"rvr", kRvrProfile},
     {"argos3", kArgos3Profile},
     {"pseudo-reality", kPseudoRealityProfile},
     {"thesis-robots", kThesisRobotsProfile},
     {"epuck", kEpuckProfile},
     {"epuck-ideal", kEpuckIdealProfile},
     {"epuck-pseudo-reality", kEpuckPseudoRealityProfile}}};

/// Reads the fields of a table; they override the fields of the profile named by `base`.
void read_fields(TableReader& table, Profile& profile) {
  const std::vector<std::string> names = profile_names();
  if (const auto base = table.choice("base", names)) {
    std::string name = std::move(profile.name);
    profile = built_in_profile(*base).value();
    profile.name = std::move(name);
  }
  read_profile_fields(table, profile);
}

/// Whether a user's profile has the name of a built-in one: a stored "rvr" must mean the built-in
/// profile.
bool takes_a_name_of_ours(const Profile& profile) {
  const auto ours = built_in_profile(profile.name);
  return ours && *ours != profile;
}

ProfileOrErrors read_profile_file(const std::filesystem::path& file) {
  const auto text = read_file(file, "profile");
  if (!text) return tl::unexpected(std::vector<Error>{text.error()});
  auto profile = parse_profile(*text, file);
  if (profile && takes_a_name_of_ours(*profile)) {
    const std::string why = "a profile gets its file's name, but `" + profile->name +
                            "` is built in with other values; rename the file";
    return tl::unexpected(std::vector<Error>{{ErrorKind::BadInput, why, file.string()}});
  }
  return profile;
}

}  // namespace

std::vector<std::string> profile_names() {
  std::vector<std::string> names;
  names.reserve(std::size(kFiles));
  for (const auto& [name, text] : kFiles)
    names.emplace_back(name);
  return names;
}

std::vector<std::string> profiles_of(const Robot& robot) {
  std::vector<std::string> names = profile_names();
  std::erase_if(names, [&](const std::string& name) {
    return misfit(built_in_profile(name).value(), robot).has_value();
  });
  return names;
}

std::string profiles_text(const Robot& robot) {
  const std::vector<std::string> names = profiles_of(robot);
  return names.empty() ? "" : " (" + joined(names) + ")";
}

std::string usual_profile(const Robot& robot) {
  const std::vector<std::string> fitting = profiles_of(robot);
  for (std::string& name : robot_names()) {
    if (std::ranges::find(fitting, name) != fitting.end()) return std::move(name);
  }
  return rvr().name;
}

std::string_view built_in_profile_text(std::string_view name) {
  for (const auto& [known, text] : kFiles) {
    if (known == name) return text;
  }
  return {};
}

Expected<Profile> built_in_profile(std::string_view name) {
  const std::string_view text = built_in_profile_text(name);
  if (text.empty()) {
    const std::vector<std::string> names = profile_names();
    return unexpected(ErrorKind::NotFound, "there is no simulator profile `" + std::string(name) +
                                               "`" + did_you_mean(name, names) +
                                               "; built in are: " + joined(names) +
                                               "; a file of your own ends in .toml");
  }
  auto profile = parse_profile(text, std::string(name) + ".toml");
  SWARMSMITH_ASSERT(profile.has_value(), "the profiles that the program carries can be read");
  return std::move(*profile);
}

ProfileOrErrors parse_profile(std::string_view text, const std::filesystem::path& file) {
  const auto document = parse_document(text, file.string());
  if (!document) return tl::unexpected(std::vector<Error>{document.error()});
  Complaints complaints(file.string());
  TableReader root(*document, "", complaints);
  Profile profile{.name = file.stem().string()};
  read_format(root);
  if (!is_name(profile.name)) {
    root.complain("name",
                  "a profile gets its file's name, so this must consist of letters, digits, "
                  "`_`, `-` and `.`; it is \"" +
                      profile.name + "\"");
  }
  read_fields(root, profile);
  root.finish();
  if (!complaints.empty()) {
    return tl::unexpected(
        complaints_about(*document, TomlKind::Profile, file.string(), complaints));
  }
  return profile;
}

ProfileOrErrors find_profile(const std::string& word, const std::filesystem::path& folder) {
  if (names_a_file(word)) return read_profile_file(folder / word);
  auto profile = built_in_profile(word);
  if (!profile) return tl::unexpected(std::vector<Error>{profile.error()});
  return std::move(*profile);
}

std::string profile_text(const Profile& profile) {
  const std::string root = "profile";
  std::string text = "format = 1\n";
  for (Section& section : profile_sections(profile, root)) {
    const bool is_top = section.header == "[" + root + "]";
    section.header = is_top ? "" : "[" + section.header.substr(root.size() + 2);
    if (is_top)  // the file gives the name
      std::erase_if(section.lines, [](const SectionLine& line) { return line.key == "name"; });
    text += text_of({section});
  }
  return text;
}

Profile read_profile_table(TableReader& table) {
  Profile profile;
  profile.name = table.text("name").value_or("");
  check_name(table, profile.name, {});
  read_fields(table, profile);
  table.finish();
  return profile;
}

}  // namespace swarmsmith
