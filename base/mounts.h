#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace swarmsmith {

/// A line of /proc/self/mountinfo (proc(5)).
struct Mount {
  int id = 0;
  std::filesystem::path root;   ///< the part of the file system that is mounted
  std::filesystem::path point;  ///< where it is mounted
  std::string type;             ///< "ext4", "cgroup2", "fuse.sshfs"
  std::string source;
  std::string options;  ///< of the file system, not of the mount: "rw,cpu,cpuacct"
};

/// The mounts that this process sees: proc/self/mountinfo below `root`. Lines of another form are
/// skipped.
std::vector<Mount> mounts(const std::filesystem::path& root = "/");

/// The text of a file in /proc or /sys, where files have no size, without the last line end; empty
/// if it cannot be read.
std::string small_system_file(const std::filesystem::path& file);

}  // namespace swarmsmith
