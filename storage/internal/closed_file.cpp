#include "storage/internal/closed_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <ctime>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "storage/internal/file_checks.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kKey = "closed";

std::string text_of(const struct statx& file, const struct timespec& changed) {
  return fmt::format("{} {}.{} {}.{}", file.stx_ino, file.stx_btime.tv_sec, file.stx_btime.tv_nsec,
                     changed.tv_sec, changed.tv_nsec);
}

/// Uses SQLite's own descriptor (decision 18).
bool look_at(const sqlite::Connection& connection, struct statx& file) {
  return connection.descriptor() >= 0 && ::statx(connection.descriptor(), "", AT_EMPTY_PATH,
                                                 STATX_BASIC_STATS | STATX_BTIME, &file) == 0;
}

/// Stores the file's identity in the file; false when it cannot be written.
bool remember(sqlite::Connection& connection, const struct timespec& now) {
  struct statx file {};
  if (!look_at(connection, file)) return false;
  try {
    sqlite::Statement(connection, "INSERT OR REPLACE INTO meta VALUES (?,?)")
        .run(kKey, text_of(file, now));
    return true;
  } catch (const sqlite::SqliteError&) {
    return false;
  }
}

}  // namespace

void close_file(sqlite::Connection& connection) {
  struct timespec now {};
  const bool known = ::clock_gettime(CLOCK_REALTIME, &now) == 0 && remember(connection, now);
  const int folded = sqlite3_wal_checkpoint_v2(connection.handle(), nullptr,
                                               SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr);
  if (!known || folded != SQLITE_OK) return;
  // The stored time was chosen before the file was written; a later writer changes the file's time.
  struct timespec times[2] = {{.tv_sec = 0, .tv_nsec = UTIME_OMIT}, now};
  (void)::futimens(connection.descriptor(), times);
}

bool is_as_closed(const sqlite::Connection& connection) {
  struct statx file {};
  if (!look_at(connection, file) || has_pending_log(connection.file())) return false;
  sqlite::Statement row(connection, "SELECT value FROM meta WHERE key = ?");
  row.bind(kKey);
  const struct timespec changed {
    .tv_sec = file.stx_mtime.tv_sec, .tv_nsec = file.stx_mtime.tv_nsec
  };
  return row.step() && row.text(0) == text_of(file, changed);
}

}  // namespace swarmsmith
