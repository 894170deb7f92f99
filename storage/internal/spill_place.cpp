#include "storage/internal/spill_place.h"

#include <sqlite3.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>

#include <fmt/format.h>

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// The VFS for one folder. SQLite may look it up by name at any time, so it is never removed.
struct SpillPlace {
  SpillPlace(const fs::path& folder, sqlite3_vfs& own)
      : vfs(own), system(&own), name("beside " + folder.string()) {
    std::uint64_t unique = 0;
    sqlite3_randomness(sizeof unique, &unique);
    for (std::size_t i = 0; i < files.size(); ++i) {
      files[i] = fmt::format("{}/.swarmsmith-spill-{:016x}-{}", folder.string(), unique, i);
      files[i].push_back('\0');  // SQLite looks for parameters after a name
    }
    vfs.zName = name.c_str();
    vfs.pNext = nullptr;
    vfs.xOpen = [](sqlite3_vfs* self, const char* path, sqlite3_file* file, int flags, int* out) {
      auto* place = reinterpret_cast<SpillPlace*>(self);
      return path != nullptr ? place->system->xOpen(place->system, path, file, flags, out)
                             : place->open(file, flags, out);
    };
  }

  /// A file has its name only for a moment: SQLite opens it as a new file and unlinks it at once.
  /// Several threads may do so at the same time, each with another name.
  int open(sqlite3_file* file, int flags, int* out) {
    const std::string& path = files[next++ % files.size()];
    const int code = system->xOpen(system, path.c_str(), file, flags, out);
    return code == SQLITE_OK ? code : system->xOpen(system, nullptr, file, flags, out);
  }

  sqlite3_vfs vfs;  ///< the first member: its address is this one's
  sqlite3_vfs* system;
  std::string name;
  std::array<std::string, 64> files;  ///< SQLite keeps a pointer to the name
  std::atomic<std::size_t> next{0};
};

}  // namespace

const char* vfs_that_spills_beside(const std::string& database) {
  if (database.empty() || database.front() == ':' || database.starts_with("file:")) return nullptr;
  if (std::getenv("SQLITE_TMPDIR") != nullptr) return nullptr;
  if (sqlite3_initialize() != SQLITE_OK) return nullptr;
  sqlite3_vfs* system = sqlite3_vfs_find("unix");
  if (system == nullptr || system != sqlite3_vfs_find(nullptr)) return nullptr;
  std::error_code trouble;
  const fs::path folder = fs::absolute(database, trouble).parent_path();
  if (trouble || ::access(folder.c_str(), W_OK) != 0) return nullptr;
  static std::mutex mutex;
  // Never destroyed: a thread may have a store open when the process ends.
  static auto& places = *new std::map<fs::path, SpillPlace*>;
  const std::scoped_lock lock(mutex);
  SpillPlace*& place = places[folder];
  if (place == nullptr) {
    place = new SpillPlace(folder, *system);
    sqlite3_vfs_register(&place->vfs, 0);
  }
  return place->name.c_str();
}

}  // namespace swarmsmith
