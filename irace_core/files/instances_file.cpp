#include "irace_core/files/instances_file.h"

#include <algorithm>
#include <system_error>

#include "base/text/whole_file.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlanks = " \t\v\f\r\n";
constexpr std::string_view kLineEnds = "\r\n";

/// Adds the files of a folder, and then those of its subfolders. `above` has the real paths of the
/// folders that contain it: a link to one of them is not followed.
std::error_code add_files(const fs::path& folder, std::vector<fs::path>& above,
                          std::vector<std::string>& files) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  if (error || std::ranges::find(above, real) != above.end()) return error;
  above.push_back(real);
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path path = entry->path();
    if (path.filename().string().starts_with('.')) continue;
    std::error_code gone;  // a broken link is not a file
    if (entry->is_directory(gone)) {
      if (const auto deeper = add_files(path, above, files)) return deeper;
    } else if (entry->exists(gone)) {
      files.push_back(path.string());
    }
  }
  above.pop_back();
  return error;
}

}  // namespace

std::vector<std::string> parse_instances(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<std::string> instances;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(kLineEnds), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = line.substr(0, line.find('#'));
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin != std::string_view::npos) instances.emplace_back(line.substr(begin));
  }
  return instances;
}

Expected<std::vector<std::string>> read_instances_file(const fs::path& file,
                                                       const fs::path& folder) {
  const auto text = read_whole_file(file);
  if (!text) return tl::unexpected(text.error());
  std::vector<std::string> instances = parse_instances(*text);
  if (instances.empty()) {
    return bad_input("names no instance; write one a line", file.string());
  }
  if (folder.empty()) return instances;
  for (std::string& instance : instances)
    instance = folder.string() + "/" + instance;
  return instances;
}

Expected<std::vector<std::string>> list_instances(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    return unexpected(ErrorKind::NotFound, "there is no such folder of instances", folder.string());
  }
  std::vector<std::string> files;
  std::vector<fs::path> above;
  if (const auto error = add_files(folder, above, files)) {
    return bad_input("cannot be listed: " + error.message(), folder.string());
  }
  if (files.empty()) return bad_input("has no files in it: no instances", folder.string());
  std::ranges::sort(files);
  return files;
}

Expected<std::string> print_instances(std::span<const std::string> instances) {
  std::string text;
  for (const std::string& instance : instances) {
    const bool can_be_said = !instance.empty() &&
                             kBlanks.find(instance.front()) == std::string_view::npos &&
                             instance.find_first_of("#\r\n") == std::string::npos;
    if (!can_be_said) {
      return bad_input(
          "a list of instances cannot hold the instance \"" + instance +
          "\": none may be empty, begin with a blank, or hold `#` or the end of a line");
    }
    text += instance + "\n";
  }
  return text;
}

}  // namespace swarmsmith
