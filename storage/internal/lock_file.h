#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// "pid=... host=...", for a process of this host.
std::string holder_text(const std::string& pid);
/// A message that another process is writing the store.
std::string in_use_text(const std::string& holder);

/// The right to be the next writer of the store with this name: an flock on the file
/// `<store>.lock`, which contains "pid=... host=..." for users. HeldFile has the right to write the
/// file itself; this lock can be taken before the file exists, and shows how the last writer ended.
/// The kernel releases the flock when the process dies, so a lock file that is left behind does not
/// block anyone; it only shows that the last writer did not end cleanly. The file is removed at the
/// end, unless the store is suspect.
class LockFile {
 public:
  /// Conflict when another process (or another store of this one) still holds it after `patience`,
  /// with its pid and host; BadInput when the file cannot be made.
  static Expected<LockFile> acquire(const std::filesystem::path& store,
                                    std::chrono::milliseconds patience);

  LockFile(LockFile&& other) noexcept;
  LockFile& operator=(LockFile&&) = delete;
  ~LockFile();

  /// The last holder died without releasing the lock.
  bool left_behind() const { return left_behind_; }

  /// While suspect, the lock file is kept at the end, so that the next program checks the store,
  /// too.
  void set_suspect(bool suspect) { suspect_ = suspect; }

 private:
  LockFile(std::filesystem::path path, int descriptor, bool left_behind)
      : path_(std::move(path)), descriptor_(descriptor), left_behind_(left_behind) {}

  std::filesystem::path path_;
  int descriptor_;
  bool left_behind_;
  bool suspect_ = false;
};

}  // namespace swarmsmith
