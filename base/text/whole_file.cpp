#include "base/text/whole_file.h"

#include <fstream>
#include <system_error>

#include "base/output_file.h"

namespace swarmsmith {

Expected<std::string> read_whole_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    return unexpected(ErrorKind::NotFound, "there is no such file", file.string());
  }
  if (std::filesystem::is_directory(status)) {
    return bad_input("is a folder; a file is wanted", file.string());
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream.is_open()) return bad_input("cannot be read", file.string());
  note_input(file);
  // Piece by piece: a pipe or a device has no length, and perhaps no end.
  constexpr std::size_t kMost = 64U << 20U;
  constexpr std::size_t kPiece = 64U << 10U;
  std::string text;
  while (stream && text.size() <= kMost) {
    const std::size_t before = text.size();
    text.resize(before + kPiece);
    stream.read(text.data() + before, kPiece);
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) return bad_input("cannot be read", file.string());
  if (text.size() > kMost) return bad_input("is larger than 64 MB", file.string());
  return text;
}

}  // namespace swarmsmith
