#include "console/whole_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "console/output.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

bool write_bytes(const fs::path& file, std::string_view bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  return stream.good();
}

}  // namespace

Expected<void> write_whole_file(const std::string& file, std::string_view bytes) {
  std::error_code failed;
  // A link keeps pointing to what is written.
  fs::path place = fs::weakly_canonical(file, failed);
  if (failed) place = file;
  const fs::file_status status = fs::status(place, failed);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    if (!fs::is_directory(status) && write_bytes(place, bytes)) return {};
    return Unexpected(cannot_write(file));
  }
  fs::path beside = place;
  beside += ".part" + std::to_string(getpid());
  bool is_written = write_bytes(beside, bytes);
  if (is_written) {
    fs::rename(beside, place, failed);
    is_written = !failed;
  }
  if (is_written) return {};
  fs::remove(beside, failed);
  return Unexpected(cannot_write(file));
}

}  // namespace swarmsmith::cli
