// A library for LD_PRELOAD: writes down who opens a store besides SQLite. A process that closes any
// descriptor of a file loses its locks on it, so no program may.
//
//   SWARMSMITH_BESIDE_LOG  where a line is added for each such call: the caller's library, the path
//
// A store is a file whose name ends in ".db" and that begins as SQLite's files do.

#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace {

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

using Open = int(const char*, int, ...);
using OpenAt = int(int, const char*, int, ...);
using FileOpen = std::FILE*(const char*, const char*);

bool is_store(const char* path) {
  if (path == nullptr || !std::string_view(path).ends_with(".db")) return false;
  static auto* const open_file = real<Open>("open");
  const int file = open_file(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  std::array<char, 16> begin{};
  const bool reads = read(file, begin.data(), begin.size()) == static_cast<ssize_t>(begin.size());
  // Looking is opening, too: the descriptor stays.
  return reads && std::memcmp(begin.data(), "SQLite format 3", begin.size()) == 0;
}

std::string library_of(const void* address) {
  Dl_info about{};
  return dladdr(address, &about) != 0 && about.dli_fname != nullptr ? about.dli_fname : "unknown";
}

/// Whether SQLite is among the next callers: its own call of open may go through a function of the
/// program (sqlite3_vfs::xSetSystemCall), which then opens for it.
bool is_for_sqlite() {
  std::array<void*, 6> callers{};
  const int count = backtrace(callers.data(), static_cast<int>(callers.size()));
  return std::any_of(callers.begin(), callers.begin() + count, [](const void* caller) {
    return library_of(caller).find("libsqlite3") != std::string::npos;
  });
}

void look(const char* path, const void* caller) {
  const char* log = std::getenv("SWARMSMITH_BESIDE_LOG");
  if (log == nullptr || is_for_sqlite() || !is_store(path)) return;
  const std::string library = library_of(caller);
  const std::string line = library + " " + path + "\n";
  static auto* const open_file = real<Open>("open");
  const int file = open_file(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  (void)!write(file, line.data(), line.size());
  close(file);
}

mode_t mode_of(int flags, std::va_list words) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(words, mode_t) : 0;
}

}  // namespace

// NOLINTBEGIN(cert-dcl50-cpp): as the C library has them
extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list words;
  va_start(words, flags);
  const mode_t mode = mode_of(flags, words);
  va_end(words);
  look(path, __builtin_return_address(0));
  static auto* const call = real<Open>("open");
  return call(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  std::va_list words;
  va_start(words, flags);
  const mode_t mode = mode_of(flags, words);
  va_end(words);
  look(path, __builtin_return_address(0));
  static auto* const call = real<Open>("open64");
  return call(path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  std::va_list words;
  va_start(words, flags);
  const mode_t mode = mode_of(flags, words);
  va_end(words);
  look(path, __builtin_return_address(0));
  static auto* const call = real<OpenAt>("openat");
  return call(folder, path, flags, mode);
}
std::FILE* fopen(const char* path, const char* mode) {
  look(path, __builtin_return_address(0));
  static auto* const call = real<FileOpen>("fopen");
  return call(path, mode);
}
std::FILE* fopen64(const char* path, const char* mode) {
  look(path, __builtin_return_address(0));
  static auto* const call = real<FileOpen>("fopen64");
  return call(path, mode);
}

}  // extern "C"
// NOLINTEND(cert-dcl50-cpp)
