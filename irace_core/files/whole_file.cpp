#include "irace_core/files/whole_file.h"

#include <fstream>
#include <iterator>
#include <system_error>

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
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) return bad_input("cannot be read", file.string());
  return text;
}

}  // namespace swarmsmith
