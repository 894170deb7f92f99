#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace swarmsmith {

/// What the control groups of this process leave it: the least of its own group and of all groups
/// above it that can be seen from here. Empty: no limit.
struct CgroupLimits {
  std::optional<double> processors;           ///< quota / period: half a processor is 0.5
  std::optional<std::uint64_t> memory_bytes;  ///< of all processes of the group together

  friend bool operator==(const CgroupLimits&, const CgroupLimits&) = default;
};

/// Reads proc/self/cgroup, proc/self/mountinfo and the groups' own files below `root`: version 2
/// (cpu.max, memory.max) and version 1 (cpu.cfs_quota_us, memory.limit_in_bytes). What is not there
/// or cannot be read does not limit.
CgroupLimits cgroup_limits(const std::filesystem::path& root = "/");

}  // namespace swarmsmith
