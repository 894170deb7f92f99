#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace swarmsmith {

/// The limits that control groups set for this process: the smallest of its own group and of all
/// visible groups above it. Empty: no limit.
struct CgroupLimits {
  std::optional<double> processors;           ///< quota / period: half a processor is 0.5
  std::optional<std::uint64_t> memory_bytes;  ///< of all processes of the group together

  friend bool operator==(const CgroupLimits&, const CgroupLimits&) = default;
};

/// Reads proc/self/cgroup, proc/self/mountinfo and the groups' own files below `root`, of version 2
/// (cpu.max, memory.max) and version 1 (cpu.cfs_quota_us, memory.limit_in_bytes). A file that does
/// not exist or cannot be read sets no limit.
CgroupLimits cgroup_limits(const std::filesystem::path& root = "/");

}  // namespace swarmsmith
