#include "base/program_path.h"

#include <sys/auxv.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
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

namespace {

/// The file of this process's program; empty without /proc, or if the program was started by its
/// own loader.
std::optional<fs::path> running_file() {
  std::error_code failed;
  fs::path file = fs::read_symlink("/proc/self/exe", failed);
  if (failed || file.filename() == "ld.so") return std::nullopt;
  return file;
}

}  // namespace

fs::path own_program() {
  if (auto file = running_file()) return *file;
  // The launcher passes its own path as the name of the program.
  const fs::path named = program_invocation_name;
  if (named.is_absolute()) return named;
  std::error_code failed;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): getauxval returns addresses as numbers
  const auto* const called = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  return called == nullptr ? fs::path() : fs::absolute(called, failed);
}

fs::path same_program() {
  return running_file() ? fs::path("/proc/self/exe") : own_program();
}

fs::path sibling_program(const char* variable, std::string_view name) {
  if (const std::string named = environment(variable); !named.empty()) return named;
  return own_program().parent_path() / name;
}

}  // namespace swarmsmith
