#include "base/text/file_text.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/output_file.h"

namespace swarmsmith {
namespace {

/// Of the files that this program reads; raised when an old file would mean something else.
constexpr std::int64_t kFormat = 1;

}  // namespace

Expected<std::string> read_file(const std::filesystem::path& file, const std::string& what,
                                std::size_t most) {
  std::error_code trouble;
  if (std::filesystem::is_directory(file, trouble)) {
    return bad_input("this is a folder, not a " + what + " file", file.string());
  }
  if (!std::filesystem::exists(file, trouble) && !trouble) {
    return unexpected(ErrorKind::NotFound, "there is no such " + what + " file", file.string());
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return bad_input("the " + what + " file cannot be read: " + std::strerror(errno),
                     file.string());
  }
  note_input(file);
  // Piece by piece: the whole of `most` would cost more than the rest of a short command.
  constexpr std::size_t kPiece = 64U << 10U;
  std::string bytes;
  while (stream && bytes.size() <= most) {
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min(kPiece, most + 1 - before));
    stream.read(bytes.data() + before, static_cast<std::streamsize>(bytes.size() - before));
    bytes.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (bytes.size() > most) {
    return bad_input("the file is larger than " + std::to_string(most >> 20U) + " MB",
                     file.string());
  }
  return bytes;
}

bool names_a_file(const std::string& word) {
  return word.ends_with(".toml") || word.find('/') != std::string::npos;
}

void read_format(TableReader& root) {
  const auto format = root.integer("format", {1, 1'000'000});
  if (!root.has("format")) {
    root.complain("format", "the file begins with its format: format = 1");
  } else if (format && *format != kFormat) {
    root.complain("format", "format " + std::to_string(*format) +
                                " is newer than this program, which reads format 1");
  }
}

}  // namespace swarmsmith
