#include "base/cgroup.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "base/mounts.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// A control group of this process: "2:cpu,cpuacct:/job/7", or "0::/job/7" for version 2.
struct Group {
  std::vector<std::string> controllers;  ///< empty: version 2
  fs::path path;
};

std::vector<std::string> split(std::string_view text, char mark) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(mark), text.size());
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

bool has(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::vector<Group> own_groups(const fs::path& root) {
  std::vector<Group> groups;
  for (const std::string& line : split(small_system_file(root / "proc/self/cgroup"), '\n')) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    groups.push_back({split(std::string_view(line).substr(first + 1, second - first - 1), ','),
                      line.substr(second + 1)});
  }
  return groups;
}

bool goes_up(const fs::path& path) {
  return std::find(path.begin(), path.end(), "..") != path.end();
}

bool only_goes_up(const fs::path& path) {
  return std::all_of(path.begin(), path.end(),
                     [](const fs::path& name) { return name == "/" || name == ".."; });
}

/// The folders of a group and of the groups above it, as far as the mount shows them.
std::vector<fs::path> folders_of(const Group& group, const Mount& mount) {
  // A mount from outside of the namespace of our group shows a group above ours, but not which of
  // the groups below is ours.
  if (goes_up(mount.root))
    return only_goes_up(mount.root) ? std::vector{mount.point} : std::vector<fs::path>();
  const fs::path inside = group.path.lexically_relative(mount.root);
  if (inside.empty() || goes_up(inside)) return {};
  std::vector<fs::path> folders{mount.point};
  for (const fs::path& name : inside) {
    if (name != ".") folders.push_back(folders.back() / name);
  }
  return folders;
}

/// The folders below `root` that limit a controller.
std::vector<fs::path> folders(const fs::path& root, std::string_view controller) {
  std::vector<fs::path> all;
  const std::vector<Group> groups = own_groups(root);
  for (const Mount& mount : mounts(root)) {
    const bool is_second = mount.type == "cgroup2";
    if (!is_second && (mount.type != "cgroup" || !has(split(mount.options, ','), controller)))
      continue;
    for (const Group& group : groups) {
      if (is_second ? !group.controllers.empty() : !has(group.controllers, controller)) continue;
      for (const fs::path& folder : folders_of(group, mount))
        all.push_back(root / folder.relative_path());
    }
  }
  return all;
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;  // "max", or no value
  return value;
}

std::optional<double> share(std::optional<double> quota, std::optional<double> period) {
  if (!quota || !period || !(*quota > 0) || !(*period > 0)) return std::nullopt;  // -1: no limit
  return *quota / *period;
}

template <class Number>
void keep_least(std::optional<Number>& least, std::optional<Number> other) {
  if (other && (!least || *other < *least)) least = other;
}

}  // namespace

CgroupLimits cgroup_limits(const fs::path& root) {
  CgroupLimits limits;
  for (const fs::path& folder : folders(root, "cpu")) {
    const std::vector<std::string> both = split(small_system_file(folder / "cpu.max"), ' ');
    if (both.size() == 2) keep_least(limits.processors, share(number(both[0]), number(both[1])));
    keep_least(limits.processors, share(number(small_system_file(folder / "cpu.cfs_quota_us")),
                                        number(small_system_file(folder / "cpu.cfs_period_us"))));
  }
  // Version 1 writes "no limit" as the largest number of pages.
  constexpr double kNoLimit = 1e18;
  for (const fs::path& folder : folders(root, "memory")) {
    for (const char* file : {"memory.max", "memory.limit_in_bytes"}) {
      const auto bytes = number(small_system_file(folder / file));
      if (bytes && *bytes < kNoLimit)
        keep_least(limits.memory_bytes, std::optional(static_cast<std::uint64_t>(*bytes)));
    }
  }
  return limits;
}

}  // namespace swarmsmith
