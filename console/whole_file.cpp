#include "console/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "base/output_file.h"
#include "console/output.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

/// 0, or the system's number of what failed.
int write_bytes(const fs::path& file, std::string_view bytes) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream.good()) return 0;
  return errno == 0 ? EIO : errno;
}

}  // namespace

Expected<void> write_whole_file(const std::string& file, std::string_view bytes) {
  const auto found = output_place(file, kind_of(bytes));
  if (!found) return Unexpected(found.error());
  const fs::path& place = *found;
  std::error_code failed;
  const fs::file_status status = fs::status(place, failed);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    const int trouble = fs::is_directory(status) ? EISDIR : write_bytes(place, bytes);
    if (trouble == 0) return {};
    return Unexpected(cannot_write(file, trouble));
  }
  fs::path beside = place;
  beside += ".part" + std::to_string(getpid());
  int trouble = write_bytes(beside, bytes);
  if (trouble == 0) {
    fs::rename(beside, place, failed);
    if (!failed) return {};
    trouble = failed.value();
  }
  fs::remove(beside, failed);
  return Unexpected(cannot_write(file, trouble));
}

}  // namespace swarmsmith::cli
