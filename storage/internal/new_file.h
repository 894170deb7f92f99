#pragma once

#include <filesystem>

#include "base/expected.h"

namespace swarmsmith {

/// A database file that is made under a name of its own beside the one that it will have, so that
/// a file of that name is a whole one. Removed at the end, with the files that
/// SQLite puts beside it, unless it was published; after a kill, by the next one of that name.
class NewFile {
 public:
  /// BadInput when there is something of that name, or the folder cannot hold a store.
  static Expected<NewFile> beside(const std::filesystem::path& wanted);

  NewFile(NewFile&& other) noexcept;
  NewFile& operator=(NewFile&&) = delete;
  ~NewFile();

  /// Where it is being made. Nothing is there at first.
  const std::filesystem::path& path() const { return part_; }
  /// Gives it its name, on disk; every connection to it must be closed. Never replaces a file that
  /// has come there meanwhile: BadInput. Unavailable when the system refuses.
  Expected<void> publish();

 private:
  NewFile(std::filesystem::path wanted, std::filesystem::path part)
      : wanted_(std::move(wanted)), part_(std::move(part)) {}

  void remove();

  std::filesystem::path wanted_;
  std::filesystem::path part_;  ///< empty when there is nothing more to remove
};

}  // namespace swarmsmith
