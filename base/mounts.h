#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swarmsmith {

/// A line of /proc/self/mountinfo (proc(5)).
struct Mount {
  int id = 0;
  std::filesystem::path root;   ///< what of the file system is mounted
  std::filesystem::path point;  ///< where
  std::string type;             ///< "ext4", "cgroup2", "fuse.sshfs"
  std::string source;
  std::string options;  ///< of the file system, not of the mount: "rw,cpu,cpuacct"
};

/// What is mounted, as this process sees it: proc/self/mountinfo below `root`. Lines of another
/// form are left out.
std::vector<Mount> mounts(const std::filesystem::path& root = "/");

/// The text of a file of /proc or /sys, which have no size, without the end of its last line; empty
/// if it cannot be read.
std::string small_system_file(const std::filesystem::path& file);

}  // namespace swarmsmith
