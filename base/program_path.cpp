#include "base/program_path.h"

#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "base/environment.h"

namespace swarmsmith {

namespace fs = std::filesystem;

bool may_be_run(const fs::path& file) {
  std::error_code trouble;
  return fs::is_regular_file(file, trouble) && ::access(file.c_str(), X_OK) == 0;
}

std::optional<fs::path> program_in(std::string_view search_path, std::string_view name) {
  while (!search_path.empty()) {
    const std::size_t end = std::min(search_path.find(':'), search_path.size());
    const fs::path folder = search_path.substr(0, end);
    search_path.remove_prefix(std::min(end + 1, search_path.size()));
    if (!folder.is_absolute()) continue;
    const fs::path file = (folder / name).lexically_normal();
    if (may_be_run(file)) return file;
  }
  return std::nullopt;
}

std::filesystem::path sibling_program(const char* variable, std::string_view name) {
  if (const std::string named = environment(variable); !named.empty()) return named;
  std::error_code failed;
  return std::filesystem::read_symlink("/proc/self/exe", failed).parent_path() / name;
}

}  // namespace swarmsmith
