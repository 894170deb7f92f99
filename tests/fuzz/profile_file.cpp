#include "sim/files/profile_file.h"

#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

/// The profile in a [profile] table that `profile_sections` has written.
Profile profile_in(const std::string& text) {
  const auto document = parse_document(text, "printed.toml");
  require(document.has_value(), "what is printed is TOML");
  Complaints complaints("printed.toml");
  TableReader root(*document, "", complaints);
  auto table = root.table("profile");
  require(table.has_value(), "the profile is in its table");
  Profile profile = read_profile_table(*table);
  require(complaints.empty(), "what is printed can be read");
  return profile;
}

}  // namespace

/// Profiles are refused with reasons and places, or read to one whose text reads back as the same.
void run(std::string_view input) {
  const auto profile = parse_profile(input, "/no-such-folder/mine.toml");
  if (!profile) {
    return require_reasons(profile.error());
  }
  const Profile again = profile_in(text_of(profile_sections(*profile, "profile")));
  require(again == *profile, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
