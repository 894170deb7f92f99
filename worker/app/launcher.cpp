// What stands for each program in the archives of packaging/bundle: starts the program of its own
// name in lib/ with the loader and the libraries that lie there. It is linked statically, so that
// it runs where nothing is installed, not even a libc.

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

/// A file of the archive.
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
  // As this program was called, through links; /proc may not be there.
  char self[PATH_MAX];
  const auto* called = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  if (called == nullptr || realpath(called, self) == nullptr) {
    fail(argc > 0 ? argv[0] : "swarmsmith", "cannot find its folder", "");
  }
  // lib/ lies beside this program, or beside its folder bin/.
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
  // Libraries of this system need its libc, which is another one.
  unsetenv("LD_PRELOAD");
  unsetenv("LD_AUDIT");
  // The program takes this path for its own (base/program_path.h): /proc/self/exe is the loader.
  std::vector<const char*> words{loader.path,    "--inhibit-cache", "--library-path",
                                 libraries.path, "--argv0",         self,
                                 program.path};
  if (argc > 1) words.insert(words.end(), argv + 1, argv + argc);
  words.push_back(nullptr);
  execv(loader.path, const_cast<char**>(words.data()));  // execv's signature; it changes nothing
  fail(name, "cannot start ", loader.path);
}
