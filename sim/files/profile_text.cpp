#include "base/text/toml_text.h"
#include "sim/files/internal/field_writer.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {

std::vector<Section> profile_sections(const Profile& profile, const std::string& header,
                                      bool in_list) {
  std::vector<Section> sections;
  FieldWriter writer(sections, header, profile.ranges);
  writer.add("name", quoted_text(profile.name));
  visit_profile_fields(profile, writer);
  writer.drop_empty();
  if (in_list) sections.front().header = "[[" + header + "]]";
  return sections;
}

}  // namespace swarmsmith
