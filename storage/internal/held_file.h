#pragma once

#include <sys/types.h>
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "base/expected.h"
#include "storage/internal/sqlite.h"

namespace swarmsmith {

/// The file that a writer's connection has open, by what it is and not by what it is called: the
/// right to write it, and whether it is still where it was. The right is an flock on the descriptor
/// with which SQLite has the file open. It goes with the file under all its names, and no other
/// lock has to do with it (decision 18). Not taken on file systems shared between hosts, where an
/// flock would stand in SQLite's own way.
class HeldFile {
 public:
  /// Of a fresh connection, which must outlive this. Conflict when another process
  /// has the right (pid and host), or the file has lost its name meanwhile; BadInput when it has a
  /// second name, which would have another log.
  static Expected<HeldFile> hold(const sqlite::Connection& connection,
                                 const std::filesystem::path& path);

  HeldFile(HeldFile&& other) noexcept;
  HeldFile& operator=(HeldFile&&) = delete;
  ~HeldFile();

  const std::filesystem::path& path() const { return path_; }

  /// Whether file, log and shared memory are still what has their names; what happened, as the
  /// beginning of a sentence, when not ("the store was deleted"). The first time, log and shared
  /// memory are taken for SQLite's: right after it has opened them.
  std::string fate();

  /// After fate() has spoken: all that was committed, in a new file beside the old name, or where
  /// there is room, for the next writer to go on from. Takes the log away where it still has its
  /// name, so that whatever file gets the store's name is not read with it. The sentence that says
  /// so, or why nothing could be saved.
  Expected<std::string> save(sqlite::Connection& connection) const;

 private:
  struct Identity {
    dev_t device = 0;
    ino_t inode = 0;
    friend bool operator==(const Identity&, const Identity&) = default;
  };

  HeldFile(int descriptor, std::filesystem::path path)
      : descriptor_(descriptor), path_(std::move(path)) {}

  /// None when nothing has the name; `known` when the system does not say.
  static std::optional<Identity> identity_of(const std::filesystem::path& path,
                                             std::optional<Identity> known);
  std::string fate_of_store() const;

  int descriptor_;  ///< SQLite's
  std::filesystem::path path_;
  /// Of log and shared memory, once they were there.
  std::array<std::optional<Identity>, 2> beside_{};
};

/// BadInput when the file has more than one name: each would have a log of its own, and what is in
/// the other's would not be seen.
Expected<void> check_only_name(const sqlite::Connection& connection,
                               const std::filesystem::path& path);

}  // namespace swarmsmith
