#include "coordinator/results/imported_world.h"

#include <utility>

#include "base/text/document.h"
#include "base/text/table_reader.h"
#include "sim/control/flavour_file.h"
#include "sim/control/flavour_text.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

constexpr const char* kPlace = "the store's imported world";
constexpr std::string_view kFirstLine =
    "# What imported machines are simulated in; this is no campaign file.\n";

}  // namespace

std::vector<Section> imported_sections(const ImportedWorld& world) {
  std::vector<Section> sections;
  const auto add = [&](std::vector<Section> more) {
    for (Section& section : more)
      sections.push_back(std::move(section));
  };
  for (const MissionEntry& mission : world.missions)
    add(mission_sections(mission));
  if (world.profile) add(profile_sections(*world.profile, "simulator.profile"));
  if (world.own_flavour != nullptr) {
    sections.push_back({"[[method]]", "", {}});
    add(flavour_sections(*world.own_flavour, "method.flavour"));
  }
  return sections;
}

std::string imported_text(const ImportedWorld& world) {
  std::vector<Section> sections = imported_sections(world);
  if (sections.empty()) return "";
  sections.insert(sections.begin(), Section{"", "", {{"format", "1"}}});
  return std::string(kFirstLine) + text_of(sections);
}

bool is_imported_text(std::string_view text) {
  return text.starts_with(kFirstLine);
}

Expected<ImportedWorld> read_imported_world(std::string_view text) {
  ImportedWorld world;
  if (text.empty()) return world;
  const auto document = parse_document(text, kPlace);
  if (!document) return Unexpected(document.error());
  Complaints complaints(kPlace);
  TableReader root(*document, "", complaints);
  read_format(root);
  if (root.has("mission")) world.missions = read_sent_missions(root);
  if (auto simulator = root.table("simulator")) {
    if (auto profile = simulator->table("profile")) world.profile = read_profile_table(*profile);
    simulator->finish();
  }
  for (TableReader& method : root.tables("method")) {
    if (auto flavour = method.table("flavour"))
      world.own_flavour = kept_flavour(read_flavour_table(*flavour));
    method.finish();
  }
  root.finish();
  if (!complaints.empty()) return Unexpected(complaints.take().front());
  return world;
}

}  // namespace swarmsmith
