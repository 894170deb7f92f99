#include "coordinator/results/import_words.h"

namespace swarmsmith {

std::string MissionWords::name_of(const std::string& in_file) const {
  if (in_file.empty()) return of_all;
  const auto found = renamed.find(in_file);
  return found == renamed.end() ? in_file : found->second;
}

Expected<MissionWords> read_mission_words(const std::vector<std::string>& words) {
  MissionWords read;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::string before = word.substr(0, equals);
    if (equals == std::string::npos) {
      if (!read.of_all.empty()) {
        return bad_input(
            "names two missions, " + read.of_all + " and " + word + "; rename with OLD=NEW",
            "--mission");
      }
      read.of_all = word;
      continue;
    }
    const std::string after = word.substr(equals + 1);
    if (before.empty() || after.empty()) {
      return bad_input("wants NAME or OLD=NEW, not `" + word + "`", "--mission");
    }
    if (!read.renamed.emplace(before, after).second) {
      return bad_input("renames " + before + " twice", "--mission");
    }
  }
  return read;
}

}  // namespace swarmsmith
