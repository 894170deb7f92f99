#include "irace_core/files/internal/programs.h"

#include <unistd.h>
#include <system_error>

#include "base/program_path.h"
#include "irace_core/files/settings.h"

namespace swarmsmith::irace {

namespace fs = std::filesystem;

fs::path find_program(std::string_view name, const fs::path& folder, std::string_view search_path) {
  const bool is_bare =
      !name.empty() && name.find('/') == std::string_view::npos && !name.starts_with('.');
  const auto found = is_bare ? program_in(search_path, name) : std::nullopt;
  return found.value_or(absolute_path(name, folder));
}

std::optional<std::string> complaint_about_program(const fs::path& program) {
  std::error_code error;
  const auto status = fs::status(program, error);
  if (!fs::exists(status)) return "there is no such program: " + program.string();
  if (fs::is_directory(status)) return program.string() + " is a folder; name a program";
  if (::access(program.c_str(), X_OK) != 0) {
    return program.string() + " is not executable; make it so with `chmod +x " + program.string() +
           "`";
  }
  return std::nullopt;
}

}  // namespace swarmsmith::irace
