#pragma once

#include <sys/types.h>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "proto/access/allow_list.h"

namespace swarmsmith {

/// clients.toml while a coordinator runs: checked again and again, and read when it has changed. A
/// list with an error is refused, and the last good one stays in use.
class AllowListFile {
 public:
  /// `now`, here and below, is wall-clock time, which decides on which days keys have expired.
  static tl::expected<AllowListFile, std::vector<Error>> open(const std::filesystem::path& file,
                                                              std::chrono::sys_seconds now);

  struct Look {
    bool changed = false;       ///< `clients` differ from those before
    std::vector<Error> faults;  ///< errors in a new list that is refused
  };
  /// With `anyway`, reads the file even if its time stamp, inode and size have not changed.
  Look look(std::chrono::sys_seconds now, bool anyway = false);

  const std::vector<ListedClient>& clients() const { return clients_; }

 private:
  struct Stamp {
    std::int64_t seconds = 0;
    std::int64_t nanoseconds = 0;
    ino_t inode = 0;
    off_t size = -1;  ///< -1: there is no file

    friend bool operator==(const Stamp&, const Stamp&) = default;
  };

  static Stamp stamp_of(const std::filesystem::path& file);

  std::filesystem::path file_;
  Stamp stamp_;
  AllowList list_;
  std::vector<ListedClient> clients_;
};

}  // namespace swarmsmith
