// The archives of packaging/bundle contain this small program instead of the real ones: it starts
// the program with its own name in lib/, with the loader and the libraries in that folder. It is
// linked statically, so that it runs on hosts where nothing is installed, not even a libc.

#include <sys/auxv.h>
#include <unistd.h>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

[[noreturn]] void fail(const char* name, const char* what, const char* path) {
  std::fprintf(stderr, "%s: %s%s: %s\n", name, what, path, std::strerror(errno));
  std::exit(127);
}

/// The path of a file in the archive.
struct Place {
  char path[PATH_MAX];

  Place(const char* folder, const char* name) {
    if (std::snprintf(path, sizeof path, "%s/%s", folder, name) < static_cast<int>(sizeof path))
      return;
    errno = ENAMETOOLONG;
    fail(name, "cannot start ", folder);
  }
};

}  // namespace

int main(int argc, char** argv) {
  // The path of this program as it was called, with links resolved. It does not need /proc.
  char self[PATH_MAX];
  const auto* called = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  if (called == nullptr || realpath(called, self) == nullptr) {
    fail(argc > 0 ? argv[0] : "swarmsmith", "cannot find its folder", "");
  }
  // lib/ is beside this program, or beside the folder bin/ that contains it.
  char folder[PATH_MAX];
  std::memcpy(folder, self, sizeof folder);
  char* const slash = std::strrchr(folder, '/');
  const char* const name = slash + 1;
  *slash = '\0';
  char* const last = std::strrchr(folder, '/');
  if (last != nullptr && std::strcmp(last, "/bin") == 0) *last = '\0';
  const Place libraries(folder, "lib");
  const Place loader(libraries.path, "ld.so");
  const Place program(libraries.path, name);
  // Libraries of this system need its own libc, which differs from ours.
  unsetenv("LD_PRELOAD");
  unsetenv("LD_AUDIT");
  // The program takes this path as its own (base/program_path.h): /proc/self/exe is the loader.
  std::vector<const char*> words{loader.path,    "--inhibit-cache", "--library-path",
                                 libraries.path, "--argv0",         self,
                                 program.path};
  if (argc > 1) words.insert(words.end(), argv + 1, argv + argc);
  words.push_back(nullptr);
  execv(loader.path, const_cast<char**>(words.data()));  // execv changes nothing
  fail(name, "cannot start ", loader.path);
}
