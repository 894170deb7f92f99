#include "base/text/whole_file.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/output_file.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// Reads at most one byte more than `most`. It reads piece by piece: a pipe or a device has no
/// length and perhaps no end, and allocating all of `most` would cost more than the rest of a short
/// command.
std::string bytes_of(std::ifstream& stream, std::size_t most) {
  constexpr std::size_t kPiece = 64U << 10U;
  std::string bytes;
  while (stream && bytes.size() <= most) {
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min(kPiece, most + 1 - before));
    stream.read(bytes.data() + before, static_cast<std::streamsize>(bytes.size() - before));
    bytes.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  return bytes;
}

/// 0, or the system's number of the error.
int write_bytes(const fs::path& file, std::string_view bytes) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream.good()) return 0;
  return errno == 0 ? EIO : errno;
}

}  // namespace

Expected<std::string> read_whole_file(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::exists(status)) {
    return unexpected(ErrorKind::NotFound, "there is no such file", file.string());
  }
  if (fs::is_directory(status)) {
    return bad_input("is a folder; name a file", file.string());
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream.is_open()) return bad_input("cannot be read", file.string());
  note_input(file);
  constexpr std::size_t kMost = 64U << 20U;
  std::string bytes = bytes_of(stream, kMost);
  if (stream.bad()) return bad_input("cannot be read", file.string());
  if (bytes.size() > kMost) return bad_input("is larger than 64 MB", file.string());
  return bytes;
}

Expected<std::string> read_file(const fs::path& file, const std::string& what, std::size_t most) {
  std::error_code trouble;
  if (fs::is_directory(file, trouble)) {
    const bool is_an =
        !what.empty() && std::string_view("aeiou").find(what[0]) != std::string_view::npos;
    return bad_input("this is a folder, not " + std::string(is_an ? "an " : "a ") + what + " file",
                     file.string());
  }
  if (!fs::exists(file, trouble) && !trouble) {
    return unexpected(ErrorKind::NotFound, "there is no such " + what + " file", file.string());
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return bad_input("the " + what + " file cannot be read: " + std::strerror(errno),
                     file.string());
  }
  note_input(file);
  std::string bytes = bytes_of(stream, most);
  if (bytes.size() > most) {
    return bad_input("the file is larger than " + std::to_string(most >> 20U) + " MB",
                     file.string());
  }
  return bytes;
}

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

}  // namespace swarmsmith
