#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "base/expected.h"

namespace swarmsmith {

/// "pid=... host=...", of a process of this host.
std::string holder_text(const std::string& pid);
/// That another process writes a store: for people.
std::string in_use_text(const std::string& holder);

/// The right to be the next to write the store of a name: an flock on the file `<store>.lock`,
/// which holds "pid=... host=..." for people. The right to write the file itself is HeldFile's;
/// this one is there before the file is, and tells how the last writer ended. The kernel gives the
/// lock back when the process dies, so that a file left behind is not an obstacle; it only says
/// that the last writer did not end well. Removed at the end, unless the store is suspect.
class LockFile {
 public:
  /// Conflict when another process (or another store of this one) holds it for as long as that,
  /// with its pid and host; BadInput when the file cannot be made.
  static Expected<LockFile> acquire(const std::filesystem::path& store,
                                    std::chrono::milliseconds patience);

  LockFile(LockFile&& other) noexcept;
  LockFile& operator=(LockFile&&) = delete;
  ~LockFile();

  /// The last holder died without giving the lock back.
  bool left_behind() const { return left_behind_; }

  /// While suspect, the file stays at the end, so that the next program looks at the store, too.
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
