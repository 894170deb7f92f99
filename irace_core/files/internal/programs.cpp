#include "irace_core/files/internal/programs.h"

#include <unistd.h>
#include <algorithm>
#include <system_error>

#include "irace_core/files/settings.h"

namespace swarmsmith::irace {

namespace fs = std::filesystem;

fs::path find_program(std::string_view name, const fs::path& folder, std::string_view search_path) {
  const bool is_bare =
      !name.empty() && name.find('/') == std::string_view::npos && !name.starts_with('.');
  while (is_bare && !search_path.empty()) {
    const std::size_t end = std::min(search_path.find(':'), search_path.size());
    const fs::path in = fs::path(search_path.substr(0, end));
    search_path.remove_prefix(std::min(end + 1, search_path.size()));
    if (!in.is_absolute()) continue;  // the current folder has no say in what is run
    const fs::path candidate = in / name;
    if (!complaint_about_program(candidate)) return candidate.lexically_normal();
  }
  return absolute_path(name, folder);
}

std::optional<std::string> complaint_about_program(const fs::path& program) {
  std::error_code error;
  const auto status = fs::status(program, error);
  if (!fs::exists(status)) return "there is no such program: " + program.string();
  if (fs::is_directory(status)) return program.string() + " is a folder; a program is wanted";
  if (::access(program.c_str(), X_OK) != 0) {
    return program.string() + " cannot be run; make it a program by `chmod +x " + program.string() +
           "`";
  }
  return std::nullopt;
}

}  // namespace swarmsmith::irace
