#include "cli/arguments/world_argument.h"

#include <vector>

#include "sim/control/flavour_file.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "sim/files/robot_file.h"

namespace swarmsmith::cli {
namespace {

Unexpected complain(const std::vector<Error>& errors, const std::string& flag, Output& output) {
  for (std::size_t i = 0; i + 1 < errors.size(); ++i)
    print_error(output, errors[i]);
  const Error& last = errors.back();
  return bad_input(last.message, last.where.empty() ? flag : last.where);
}

}  // namespace

Expected<Mission> find_mission_or_complain(const std::string& word, const std::string& flag,
                                           Output& output) {
  auto found = find_mission(word, {});
  if (!found) return complain(found.error(), flag, output);
  return std::move(found->mission);
}

Expected<Profile> find_profile_or_complain(const std::string& word, const std::string& flag,
                                           Output& output) {
  auto found = find_profile(word, {});
  if (!found) return complain(found.error(), flag, output);
  return std::move(*found);
}

Expected<Flavour> find_flavour_or_complain(const std::string& word, const std::string& flag,
                                           Output& output) {
  auto found = find_flavour_file(word, {});
  if (!found) return complain(found.error(), flag, output);
  return std::move(*found);
}

Expected<Robot> find_robot_or_complain(const std::string& word, const std::string& flag,
                                       Output& output) {
  auto found = find_robot(word, {});
  if (!found) return complain(found.error(), flag, output);
  return std::move(*found);
}

}  // namespace swarmsmith::cli
