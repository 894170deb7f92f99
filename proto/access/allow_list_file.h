#pragma once

#include <sys/types.h>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "proto/access/allow_list.h"

namespace swarmsmith {

/// clients.toml while a coordinator runs: looked at again and again, read when it changed. A list
/// with a mistake is refused, and the last good one stays.
class AllowListFile {
 public:
  /// `now` is wall-clock time, here and below, for the days on which keys expire.
  static tl::expected<AllowListFile, std::vector<Error>> open(const std::filesystem::path& file,
                                                              std::chrono::sys_seconds now);

  struct Look {
    bool changed = false;       ///< `clients` are others than before
    std::vector<Error> faults;  ///< of a new file that is not taken
  };
  /// `anyway`: reads it even when time stamp, number and size of the file are those of the last
  /// time.
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
