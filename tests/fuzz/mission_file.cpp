#include "sim/files/mission_file.h"

#include "tests/fuzz/printed_table.h"

namespace swarmsmith::fuzz {

/// Missions in a folder that is not there, so that no image they name is read: refused with reasons
/// and places, or read to a mission whose text reads back as the same.
void run(std::string_view input) {
  const auto mission = parse_mission(input, "/no-such-folder/of/missions/mission.toml");
  if (!mission) return require_reasons(mission.error());
  const auto again = read_printed(text_of(mission_sections(*mission)), [](TableReader& root) {
    std::vector<MissionEntry> missions = read_missions(root, "/no-such-folder");
    root.finish();
    return missions;
  });
  require(again.size() == 1 && again[0] == *mission, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
