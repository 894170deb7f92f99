#include "storage/internal/held_file.h"

#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "storage/internal/file_checks.h"
#include "storage/internal/lock_file.h"
#include "storage/internal/new_file.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr std::array kBeside{"-wal", "-shm"};

/// The process that has an flock on the file, from the kernel's list.
std::string holder_of(const struct stat& file) {
  const std::string place =
      fmt::format("{:02x}:{:02x}:{}", major(file.st_dev), minor(file.st_dev), file.st_ino);
  std::ifstream locks("/proc/locks");
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, kind, advisory, access, pid, where;
    words >> number >> kind >> advisory >> access >> pid >> where;
    if (kind == "FLOCK" && access == "WRITE" && where == place) return holder_text(pid);
  }
  return {};
}

bool is_on_shared_file_system(int descriptor) {
  return !shared_file_system(fmt::format("/proc/self/fd/{}", descriptor)).empty();
}

/// The first of the names "s.db.saved", "s.db.saved-2", ... that no file has.
fs::path free_name(const fs::path& folder, const fs::path& store) {
  const fs::path wanted = folder / (store.filename().string() + ".saved");
  fs::path name = wanted;
  std::error_code ignored;
  for (int n = 2; fs::exists(fs::symlink_status(name, ignored)); ++n)
    name = fmt::format("{}-{}", wanted.string(), n);
  return name;
}

Expected<void> copy_into(sqlite::Connection& connection, const fs::path& name) {
  auto copy = NewFile::beside(name);
  if (!copy) return Unexpected(copy.error());
  try {
    sqlite::Statement(connection, "VACUUM INTO ?").run(copy->path().string());
  } catch (const sqlite::SqliteError& error) {
    return unexpected(ErrorKind::Unavailable, error.what(), name.string());
  }
  return copy->publish();
}

/// Copies into the first of these folders where that works: the store's own folder may be gone, or
/// full.
Expected<fs::path> copy_beside(sqlite::Connection& connection, const fs::path& path) {
  std::error_code ignored;
  Expected<void> copied;
  for (const fs::path& folder :
       {path.parent_path(), fs::current_path(ignored), fs::temp_directory_path(ignored)}) {
    const fs::path name = free_name(folder, path);
    copied = copy_into(connection, name);
    if (copied) return name;
  }
  return Unexpected(copied.error());
}

}  // namespace

Expected<void> check_only_name(const sqlite::Connection& connection, const fs::path& path) {
  struct stat file {};
  if (::fstat(connection.descriptor(), &file) != 0 || file.st_nlink <= 1) return {};
  return bad_input(
      "the store has a second name (a hard link), and SQLite keeps a log for each name: rows in "
      "the other log would be missing here; remove the other name, or copy the file and use the "
      "copy",
      path.string());
}

Expected<HeldFile> HeldFile::hold(const sqlite::Connection& connection, const fs::path& path) {
  const int descriptor = connection.descriptor();
  struct stat file {};
  if (::fstat(descriptor, &file) != 0) {
    return unexpected(ErrorKind::Unavailable, "cannot be looked at", path.string());
  }
  if (!is_on_shared_file_system(descriptor) && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    return unexpected(ErrorKind::Conflict, in_use_text(holder_of(file)), path.string());
  }
  HeldFile held(descriptor, path);
  if (auto only = check_only_name(connection, path); !only) return Unexpected(only.error());
  if (const std::string fate = held.fate_of_store(); !fate.empty()) {
    return unexpected(ErrorKind::Conflict, fate + " while it was opened; try again", path.string());
  }
  return held;
}

HeldFile::HeldFile(HeldFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      path_(std::move(other.path_)),
      beside_(other.beside_) {}

HeldFile::~HeldFile() {
  // SQLite may keep the descriptor for a while after the connection is closed.
  if (descriptor_ >= 0) ::flock(descriptor_, LOCK_UN);
}

std::optional<HeldFile::Identity> HeldFile::identity_of(const fs::path& path,
                                                        std::optional<Identity> known) {
  struct stat file {};
  if (::stat(path.c_str(), &file) == 0) return Identity{file.st_dev, file.st_ino};
  const bool is_gone = errno == ENOENT || errno == ENOTDIR;
  return is_gone ? std::nullopt : known;
}

std::string HeldFile::fate_of_store() const {
  struct stat file {};
  if (::fstat(descriptor_, &file) != 0) return "the store's file is closed";
  const Identity held{file.st_dev, file.st_ino};
  const auto named = identity_of(path_, held);
  if (named == held) return {};
  std::string fate = "the store was deleted";
  if (file.st_nlink > 0) {
    std::error_code none;
    const fs::path now = fs::read_symlink(fmt::format("/proc/self/fd/{}", descriptor_), none);
    fate = none ? "the store was renamed" : "the store was renamed to " + now.string();
  }
  return named ? fate + ", and another file has its name," : fate;
}

std::string HeldFile::fate() {
  if (std::string fate = fate_of_store(); !fate.empty()) return fate;
  for (std::size_t i = 0; i < kBeside.size(); ++i) {
    const std::string name = path_.string() + kBeside[i];
    const auto now = identity_of(name, beside_[i]);
    if (!beside_[i]) beside_[i] = now;
    if (now == beside_[i]) continue;
    return fmt::format("{}, which SQLite needs beside the store, was {}", name,
                       now ? "replaced" : "deleted or renamed");
  }
  return {};
}

Expected<std::string> HeldFile::save(sqlite::Connection& connection) const {
  const auto copy = copy_beside(connection, path_);
  if (!copy) return Unexpected(copy.error());
  for (std::size_t i = 0; i < kBeside.size(); ++i) {
    const std::string name = path_.string() + kBeside[i];
    if (beside_[i] && identity_of(name, std::nullopt) == beside_[i]) ::unlink(name.c_str());
  }
  return fmt::format(
      "everything so far is in {0}: `mv {0} {1}` gives it its name back, and the same command "
      "continues from there",
      copy->string(), path_.string());
}

}  // namespace swarmsmith
