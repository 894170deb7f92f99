#include "tracking/app/written_files.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/output_file.h"
#include "base/text/toml_text.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

Error is_there(const std::string& file, const std::string& what) {
  return {ErrorKind::BadInput,
          "already exists" + what +
              " and would be lost; name another file to write, or remove "
              "this one first",
          file};
}

/// The beginning of a file, which has the keys that say what it is; empty if it cannot be read.
std::string head_of(const fs::path& file) {
  constexpr std::size_t kMost = 4096;
  std::ifstream stream(file, std::ios::binary);
  std::string text(kMost, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(kMost));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return "\n" + text;
}

bool says(const std::string& head, const std::string& key, std::string_view value) {
  return head.find("\n" + key + " = " + quoted_text(value)) != std::string::npos;
}

}  // namespace

std::optional<Error> flaw_of_output(const std::string& file) {
  if (file.empty() || file == "-") return std::nullopt;
  std::error_code trouble;
  const fs::path path(file);
  if (fs::is_directory(path, trouble)) return cannot_write(file, EISDIR);
  // Links, pipes and devices are only tried when they are written.
  const fs::file_status status = fs::symlink_status(path, trouble);
  if (fs::exists(status) && !fs::is_regular_file(status)) return std::nullopt;
  const fs::path parent = path.parent_path();
  const fs::path folder = parent.empty() ? fs::path(".") : parent;
  if (access(folder.c_str(), W_OK | X_OK) == 0) return std::nullopt;
  return cannot_write(file, errno);
}

std::optional<Error> flaw_of_new_output(const std::string& file) {
  if (file.empty() || file == "-") return std::nullopt;
  std::error_code trouble;
  if (fs::is_regular_file(file, trouble)) return is_there(file, "");
  return flaw_of_output(file);
}

std::optional<Error> flaw_of_new_folder(const std::string& folder) {
  std::error_code trouble;
  if (fs::is_directory(folder, trouble) && !fs::is_empty(folder, trouble)) {
    return Error{ErrorKind::BadInput,
                 "this folder already exists and is not empty; name another folder for the "
                 "pictures",
                 folder};
  }
  fs::path there = fs::absolute(folder, trouble);
  while (there.has_relative_path() && !fs::exists(there, trouble))
    there = there.parent_path();
  if (!fs::is_directory(there, trouble)) return cannot_write(folder, ENOTDIR);
  if (access(there.c_str(), W_OK | X_OK) == 0) return std::nullopt;
  return cannot_write(folder, errno);
}

std::optional<Error> flaw_of_calibration_output(const std::string& file, CalibrationKind kind,
                                                const std::string& robot) {
  if (auto flaw = flaw_of_output(file)) return flaw;
  std::error_code trouble;
  if (!fs::is_regular_file(file, trouble) || fs::file_size(file, trouble) == 0) return std::nullopt;
  const std::string head = head_of(file);
  const bool is_ours =
      says(head, "kind", name_of(kind)) && (robot.empty() || says(head, "robot", robot));
  if (is_ours) return std::nullopt;
  std::string what = ", is not the " + std::string(name_of(kind)) + " calibration";
  if (!robot.empty()) what += " of " + robot;
  return is_there(file, what + ",");
}

}  // namespace swarmsmith
