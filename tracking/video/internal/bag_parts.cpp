#include "tracking/video/internal/bag_parts.h"

#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

#include "tracking/rig/issue.h"
#include "tracking/video/internal/ros_image.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPacked = ".zstd";

bool is_packed_bag(const std::string& name) {
  return name.ends_with(".mcap.zstd") || name.ends_with(".db3.zstd");
}

Expected<void> check_packed(const fs::path& file) {
  std::error_code ignored;
  const std::string name = file.string();
  if (!is_packed_bag(name) || fs::exists(name.substr(0, name.size() - kPacked.size()), ignored))
    return {};
  return Unexpected(error_of(IssueCode::VideoUnreadable,
                             "is packed as a whole; unpack it first (`zstd -d " +
                                 shortened(file.filename().string()) + "`)",
                             name));
}

/// The names under `relative_file_paths`, one per line.
std::vector<std::string> names_in(const fs::path& metadata) {
  constexpr int kMostLines = 100'000;
  std::ifstream file(metadata);
  std::vector<std::string> names;
  std::string line;
  bool is_list = false;
  for (int i = 0; i < kMostLines && std::getline(file, line); ++i) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string::npos) continue;
    line = line.substr(begin, line.find_last_not_of(" \t\r\"'") + 1 - begin);
    if (is_list && line.starts_with("- ")) {
      const std::size_t name = line.find_first_not_of(" \"'", 1);
      if (name != std::string::npos) names.push_back(line.substr(name));
    } else if (is_list) {
      break;
    }
    is_list = is_list || line == "relative_file_paths:";
  }
  return names;
}

}  // namespace

Expected<void> check_bag_parts(const std::string& word) {
  std::error_code error;
  if (!fs::is_directory(word, error)) {
    return fs::is_regular_file(word, error) ? check_packed(word) : Expected<void>();
  }
  // Early versions wrote the folder's name before the file name.
  for (const std::string& name : names_in(fs::path(word) / "metadata.yaml")) {
    const fs::path part = fs::path(word) / fs::path(name).filename();
    if (fs::exists(part, error)) continue;
    if (is_packed_bag(name) &&
        fs::exists(part.string().substr(0, part.string().size() - kPacked.size()), error))
      continue;
    return Unexpected(error_of(IssueCode::VideoUnreadable,
                               "metadata.yaml names " + shortened(name) +
                                   ", which is not there; copy the bag's folder whole",
                               word));
  }
  for (fs::directory_iterator entry(word, error), end; !error && entry != end;
       entry.increment(error)) {
    if (auto packed = check_packed(entry->path()); !packed) return packed;
  }
  return {};
}

}  // namespace swarmsmith
