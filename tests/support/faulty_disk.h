#pragma once

#include <sqlite3.h>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "base/rng.h"

namespace swarmsmith {

/// A disk that fails when a test says so: SQLite's default file system while it lives, in front of
/// the real one. Counts what changes a file (writes, syncs, truncations, deletions).
class FaultyDisk {
 public:
  FaultyDisk();
  FaultyDisk(const FaultyDisk&) = delete;
  FaultyDisk& operator=(const FaultyDisk&) = delete;
  ~FaultyDisk();

  /// From the n-th change from now on (from 1), so many changes fail with this code of SQLite's.
  void fail_at(std::int64_t n, int code, std::int64_t times = 1);
  /// The power goes at the n-th change from now on: it and all later ones fail.
  void cut_power_at(std::int64_t n);
  bool power_is_off() const { return off_; }

  /// After a cut, when no program has a file open: leaves in each file what a disk may hold then,
  /// that is what was synced, and of the later writes any part. Gives the power back.
  void restart(Rng& rng);

  std::int64_t changes() const { return changes_; }

  /// For the file system's own functions: the code with which this change fails, or SQLITE_OK.
  int next_change();
  void opened(const std::string& path);
  void wrote(const std::string& path, std::int64_t offset, const char* bytes, int size);
  void truncated(const std::string& path, std::int64_t size);
  void synced(const std::string& path);
  void deleted(const std::string& path);
  sqlite3_vfs* real() const { return real_; }

 private:
  struct Change {
    std::int64_t offset = 0;
    std::string bytes;
    bool truncation = false;  ///< to `offset`
  };
  struct Image {
    std::string synced;
    std::vector<Change> pending;
  };
  static void apply(std::string& content, const Change& change);

  sqlite3_vfs* real_;
  sqlite3_vfs shim_{};
  std::mutex mutex_;
  std::map<std::string, Image> images_;
  std::int64_t changes_ = 0;
  std::int64_t first_failure_ = 0, failures_ = 0;
  int code_ = SQLITE_OK;
  bool cut_ = false, off_ = false;
};

}  // namespace swarmsmith
