// The program `swarmsmith-worker` of a bundle (packaging/bundle): starts the worker of lib/ with
// the loader and the libraries that lie there. It is linked statically, so that it runs where
// nothing is installed, not even a libc.

#include <sys/auxv.h>
#include <unistd.h>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

/// A file of the bundle.
struct Place {
  char path[PATH_MAX];

  Place(const char* folder, const char* name) {
    if (std::snprintf(path, sizeof path, "%s/%s", folder, name) < static_cast<int>(sizeof path))
      return;
    std::fprintf(stderr, "swarmsmith-worker: the name of its folder is too long\n");
    std::exit(127);
  }
};

}  // namespace

int main(int argc, char** argv) {
  // As this program was called, through links; /proc may not be there.
  char folder[PATH_MAX];
  const auto* called = reinterpret_cast<const char*>(getauxval(AT_EXECFN));
  if (called == nullptr || realpath(called, folder) == nullptr) {
    std::fprintf(stderr, "swarmsmith-worker: cannot find its folder: %s\n", std::strerror(errno));
    return 127;
  }
  *std::strrchr(folder, '/') = '\0';
  // Beside this program: to the worker, /proc/self/exe is the loader, and other programs lie in its
  // folder (base/program_path.h).
  const Place loader(folder, "ld.so");
  const Place libraries(folder, "lib");
  const Place worker(folder, "lib/swarmsmith-worker");
  // Libraries of this system need its libc, which is another one.
  unsetenv("LD_PRELOAD");
  unsetenv("LD_AUDIT");
  std::vector<const char*> words{loader.path, "--inhibit-cache", "--library-path", libraries.path,
                                 "--argv0",   argv[0],           worker.path};
  words.insert(words.end(), argv + 1, argv + argc + 1);
  execv(loader.path, const_cast<char**>(words.data()));  // execv's signature; it changes nothing
  std::fprintf(stderr, "swarmsmith-worker: cannot start %s: %s\n", loader.path,
               std::strerror(errno));
  return 127;
}
