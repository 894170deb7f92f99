#include "sim/files/profile_file.h"

#include "tests/fuzz/printed_table.h"

namespace swarmsmith::fuzz {

/// Profiles are refused with reasons and places, or read to one whose text reads back as the same.
void run(std::string_view input) {
  const auto profile = parse_profile(input, "/no-such-folder/mine.toml");
  if (!profile) return require_reasons(profile.error());
  const Profile again =
      read_printed(text_of(profile_sections(*profile, "profile")), [](TableReader& root) {
        auto table = root.table("profile");
        require(table.has_value(), "the profile is in its table");
        return read_profile_table(*table);
      });
  require(again == *profile, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
