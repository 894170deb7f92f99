#include "coordinator/launchers/worker_bundle.h"

#include <algorithm>

#include "base/process/process.h"
#include "base/program_path.h"
#include "base/text/sha256.h"
#include "coordinator/launchers/worker_program.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kArchitectures[] = {"x86_64", "aarch64"};
constexpr const char* kPlaces[] = {"../bundle", "../share/swarmsmith"};

// Works in any login shell that passes it on to sh: no line breaks, no single quotes. It uses only
// programs that every Linux host has, so not xz.

constexpr std::string_view kCache = "${XDG_CACHE_HOME:-$HOME/.cache}/swarmsmith";

/// Whether all files of the folder $1 are present and unchanged.
constexpr std::string_view kIsWhole =
    R"(whole() { (cd "$1" && sha256sum -c SHA256SUMS) >/dev/null 2>&1; }; )";

/// $1: folder in the cache; $2: folder in the archive, which comes on the standard input. If
/// another installation has put the folder there in the meantime, mv moves this one into it. Files
/// get the time of the installation as their modification time, because caches are emptied by age.
/// Leftovers of a killed installation are removed after a day.
constexpr std::string_view kInstall =
    R"(fail() { echo "$1" | head -n 1 >&2; exit 1; }; clean() { rm -rf "$t"; }; )"
    R"(e=$(mkdir -p "$c" 2>&1) || fail "$e"; cd "$c" || exit 1; )"
    R"(if ! whole "$1"; then )"
    R"(find . -maxdepth 1 -name "new.*" -mtime +0 -exec rm -rf {} + 2>/dev/null; )"
    R"(t=$(mktemp -d "$PWD/new.XXXXXX") || exit 1; )"
    R"(trap clean EXIT; trap "exit 1" HUP INT TERM; )"
    R"(e=$(tar -xomf - -C "$t" 2>&1) || fail "$e"; )"
    R"(whole "$t/$2" || fail "not all of it arrived"; )"
    R"(test ! -e "$1" || whole "$1" || rm -rf "$1"; )"
    R"(e=$(mv "$t/$2" "$1" 2>&1) || fail "$e"; rm -rf "$1/$2"; fi; pwd)";

std::string line(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

/// Whether xz can decompress the whole archive.
Expected<void> check(const fs::path& archive) {
  const Interrupt never;
  const auto end = run_process({.words = {"xz", "-tq", archive.string()}}, never);
  if (!end) {
    return unexpected(end.error().kind, end.error().message + " (package xz-utils)",
                      archive.string());
  }
  if (end->signal == 0 && end->exit_code == 0) return {};
  return unexpected(
      ErrorKind::Unavailable,
      "the bundle is damaged; make it again (`./dev bundle`), or download it again (" +
          line(end->errors.text) + ")",
      archive.string());
}

}  // namespace

Expected<std::vector<WorkerBundle>> find_bundles() {
  std::vector<WorkerBundle> bundles;
  fs::path folder;
  const std::string begin = std::string("swarmsmith-worker-") + SWARMSMITH_VERSION + "-";
  for (const char* place : kPlaces) {
    if (!bundles.empty()) break;
    folder = sibling_program("SWARMSMITH_BUNDLES", place).lexically_normal();
    for (const std::string_view architecture : kArchitectures) {
      const std::string name = begin + std::string(architecture);
      const fs::path archive = folder / (name + ".tar.xz");
      const auto hash = sha256_of_file(archive.string());
      if (!hash && hash.error().kind == ErrorKind::NotFound) continue;
      if (!hash) return Unexpected(hash.error());
      if (const auto checked = check(archive); !checked) return Unexpected(checked.error());
      bundles.push_back({.architecture = std::string(architecture),
                         .archive = archive,
                         .folder = name + "-" + hash->substr(0, 16)});
    }
  }
  if (!bundles.empty()) return bundles;
  return unexpected(ErrorKind::NotFound,
                    "there is no bundle to send: `./dev bundle` makes " + begin +
                        "x86_64.tar.xz; put the one of your release here, or name its folder in "
                        "SWARMSMITH_BUNDLES",
                    folder.string());
}

std::vector<std::string> start_words(const std::vector<WorkerBundle>& bundles,
                                     const fs::path& cache,
                                     const std::vector<std::string>& arguments) {
  std::string script = std::string(kIsWhole) + "c=$1; shift; c=${c:-" + std::string(kCache) +
                       "}; case $(uname -m) in ";
  int missing = kNotInCache;
  for (const WorkerBundle& bundle : bundles) {
    script +=
        bundle.architecture + ") f=" + bundle.folder + " e=" + std::to_string(missing) + ";; ";
    ++missing;
  }
  script += "*) f= e=" + std::to_string(kNoBundle) + ";; esac; ";
  script += R"(if test -n "$f" && whole "$c/$f"; then exec "$c/$f/swarmsmith-worker" "$@"; fi; )"
            R"sh(echo "$c on $(uname -n) has no worker for $(uname -m)" >&2; exit $e)sh";
  std::vector<std::string> words{"sh", "-c", script, "sh", cache.string()};
  std::ranges::copy(arguments, std::back_inserter(words));
  return words;
}

std::string send_line(const WorkerBundle& bundle, const std::vector<std::string>& way) {
  const std::string name = bundle.archive.stem().stem().string();
  const std::string install =
      shell_line({"sh", "-c",
                  std::string(kIsWhole) + "c=" + std::string(kCache) + "; " + std::string(kInstall),
                  "sh", bundle.folder, name});
  std::vector<std::string> words = way;
  if (!way.empty()) words.push_back("exec " + install);
  return shell_line({"xz", "-dc", bundle.archive.string()}) + " | " +
         (way.empty() ? install : shell_line(words));
}

Expected<fs::path> install_here(const WorkerBundle& bundle) {
  const Interrupt never;
  const auto end = run_process({.words = {"/bin/sh", "-c", send_line(bundle, {})}}, never);
  if (!end) return Unexpected(end.error());
  if (end->signal == 0 && end->exit_code == 0) return line(end->output.text);
  return unexpected(ErrorKind::Unavailable,
                    "the worker cannot be put into the cache: " + line(end->errors.text),
                    bundle.archive.string());
}

}  // namespace swarmsmith
