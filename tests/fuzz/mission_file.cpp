#include "sim/files/mission_file.h"

#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

/// The [[mission]] tables of a text that `mission_sections` has written.
std::vector<MissionEntry> missions_in(const std::string& text) {
  const auto document = parse_document(text, "printed.toml");
  require(document.has_value(), "what is printed is TOML");
  Complaints complaints("printed.toml");
  TableReader root(*document, "", complaints);
  std::vector<MissionEntry> missions = read_missions(root, "/no-such-folder");
  root.finish();
  require(complaints.empty(), "what is printed can be read");
  return missions;
}

}  // namespace

/// Missions in a folder that is not there, so that no image they name is read: refused with reasons
/// and places, or read to a mission whose text reads back as the same.
void run(std::string_view input) {
  const auto mission = parse_mission(input, "/no-such-folder/of/missions/mission.toml");
  if (!mission) {
    return require_reasons(mission.error());
  }
  const std::vector<MissionEntry> again = missions_in(text_of(mission_sections(*mission)));
  require(again.size() == 1 && again[0] == *mission, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
