#pragma once

#include <sys/types.h>
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "base/expected.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// The file that a writer's connection has open, identified by the file itself and not by its name:
/// the right to write it, and whether it still has its name. The right is an flock on the
/// descriptor with which SQLite has the file open. It applies to the file under all its names, and
/// does not interfere with any other lock (decision 18). It is not taken on file systems shared
/// between hosts, where an flock would conflict with SQLite's own locks.
class HeldFile {
 public:
  /// `connection` must be fresh, and must outlive the result. Conflict when another process has the
  /// right (its pid and host), or when the file has lost its name meanwhile; BadInput when the file
  /// has a second name, since that would have another log.
  static Expected<HeldFile> hold(const sqlite::Connection& connection,
                                 const std::filesystem::path& path);

  HeldFile(HeldFile&& other) noexcept;
  HeldFile& operator=(HeldFile&&) = delete;
  ~HeldFile();

  const std::filesystem::path& path() const { return path_; }

  /// Empty while the names of file, log and shared memory still lead to the same files; otherwise
  /// what happened, as the beginning of a sentence ("the store was deleted"). The first call must
  /// come right after SQLite has opened the log and shared memory, since it assumes that they are
  /// SQLite's.
  std::string fate();

  /// Call it after fate() has reported something. Saves everything that was committed in a new file
  /// beside the old name, or in another folder if there is no room, from which the next writer can
  /// continue. Removes the log if it still has its name, so that it is not read with another file
  /// that gets the store's name. Returns a sentence that says where the rows are, or the reason why
  /// nothing could be saved.
  Expected<std::string> save(sqlite::Connection& connection) const;

 private:
  struct Identity {
    dev_t device = 0;
    ino_t inode = 0;
    friend bool operator==(const Identity&, const Identity&) = default;
  };

  HeldFile(int descriptor, std::filesystem::path path)
      : descriptor_(descriptor), path_(std::move(path)) {}

  /// Empty when no file has the name; `known` when the system cannot tell.
  static std::optional<Identity> identity_of(const std::filesystem::path& path,
                                             std::optional<Identity> known);
  std::string fate_of_store() const;

  int descriptor_;  ///< SQLite's
  std::filesystem::path path_;
  /// Of log and shared memory, once they exist.
  std::array<std::optional<Identity>, 2> beside_{};
};

/// BadInput when the file has more than one name: each name would have its own log, and rows in the
/// other name's log would not be seen.
Expected<void> check_only_name(const sqlite::Connection& connection,
                               const std::filesystem::path& path);

}  // namespace swarmsmith
