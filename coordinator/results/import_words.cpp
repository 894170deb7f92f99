#include "coordinator/results/import_words.h"

#include <algorithm>
#include <utility>

namespace swarmsmith {
namespace {

/// If the word names a file, adds the file's mission and returns its name, else returns the word.
OrErrors<std::string> mission_of(const std::string& word, MissionWords& words) {
  if (!names_a_file(word)) return word;
  auto entry = find_mission(word, {});
  if (!entry) return tl::unexpected(std::move(entry.error()));
  const std::string name = entry->mission.name;
  const MissionEntry* known = words.of_file(name);
  if (known != nullptr && *known != *entry) {
    return tl::unexpected(std::vector{
        Error{ErrorKind::BadInput, "another file has a mission " + name + ", too", word}});
  }
  if (known == nullptr) words.of_files.push_back(std::move(*entry));
  return name;
}

tl::unexpected<std::vector<Error>> wrong(std::string message) {
  return tl::unexpected(std::vector{Error{ErrorKind::BadInput, std::move(message), "--mission"}});
}

}  // namespace

std::string MissionWords::name_of(const std::string& in_file) const {
  if (in_file.empty()) return of_all;
  const auto found = renamed.find(in_file);
  if (found != renamed.end()) return found->second;
  return all_of_file ? of_all : in_file;
}

const MissionEntry* MissionWords::of_file(const std::string& name) const {
  const auto found = std::ranges::find_if(
      of_files, [&](const MissionEntry& entry) { return entry.mission.name == name; });
  return found == of_files.end() ? nullptr : &*found;
}

OrErrors<MissionWords> read_mission_words(const std::vector<std::string>& words) {
  MissionWords read;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::string before = word.substr(0, equals);
    if (equals == std::string::npos) {
      if (!read.of_all.empty()) {
        return wrong("names two missions, " + read.of_all + " and " + word +
                     "; rename with OLD=NEW");
      }
      auto name = mission_of(word, read);
      if (!name) return tl::unexpected(std::move(name.error()));
      read.of_all = std::move(*name);
      read.all_of_file = names_a_file(word);
      continue;
    }
    const std::string after = word.substr(equals + 1);
    if (before.empty() || after.empty()) {
      return wrong("must be NAME, OLD=NEW, or a mission file in place of NAME or NEW, not `" +
                   word + "`");
    }
    auto name = mission_of(after, read);
    if (!name) return tl::unexpected(std::move(name.error()));
    if (!read.renamed.emplace(before, std::move(*name)).second) {
      return wrong("renames " + before + " twice");
    }
  }
  return read;
}

}  // namespace swarmsmith
