#pragma once

#include <filesystem>

#include "base/expected.h"

namespace swarmsmith {

/// A database file that is made under a temporary name beside its final one, so that a file with
/// the final name is always complete. It is removed at the end, with the files that SQLite puts
/// beside it, unless it was published. After a kill, the next NewFile of that name removes it.
class NewFile {
 public:
  /// BadInput when a file of that name exists, or the folder cannot hold a store.
  static Expected<NewFile> beside(const std::filesystem::path& wanted);

  NewFile(NewFile&& other) noexcept;
  NewFile& operator=(NewFile&&) = delete;
  ~NewFile();

  /// The temporary name. The file does not exist at first.
  const std::filesystem::path& path() const { return part_; }
  /// Gives the file its final name, on disk; every connection to it must be closed. BadInput if
  /// another file has got that name meanwhile: that file is never replaced. Unavailable when the
  /// system refuses.
  Expected<void> publish();

 private:
  NewFile(std::filesystem::path wanted, std::filesystem::path part)
      : wanted_(std::move(wanted)), part_(std::move(part)) {}

  void remove();

  std::filesystem::path wanted_;
  std::filesystem::path part_;  ///< empty when nothing is left to remove
};

}  // namespace swarmsmith
