#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A worker with its own loader and libraries, for hosts where nothing is installed;
/// packaging/bundle makes its archive.
struct WorkerBundle {
  std::string architecture;       ///< in the format of `uname -m`
  std::filesystem::path archive;  ///< FOLDER/NAME.tar.xz, which contains the folder NAME
  std::string folder;             ///< its name in caches: NAME and the beginning of the SHA-256

  friend bool operator==(const WorkerBundle&, const WorkerBundle&) = default;
};

/// The bundles of this version, one for each architecture: in the folder given by
/// SWARMSMITH_BUNDLES, else in ../bundle (of a build) or ../share/swarmsmith, relative to the
/// folder of this program. Errors: no bundle is found, an archive is damaged, or xz is missing.
Expected<std::vector<WorkerBundle>> find_bundles();

/// Exit codes of `start_words`: there is no bundle for the host's architecture, or the bundle is
/// missing or incomplete in the cache.
constexpr int kNoBundle = 90;
constexpr int kNotInCache = 91;  ///< plus the bundle's index

/// The command line that starts the worker of the bundle that fits the host, from the host's cache
/// (~/.cache/swarmsmith, or in XDG_CACHE_HOME), or from `cache`. If the bundle is not there, the
/// command prints one line with the host's architecture, and exits with one of the codes above.
std::vector<std::string> start_words(const std::vector<WorkerBundle>& bundles,
                                     const std::filesystem::path& cache,
                                     const std::vector<std::string>& arguments);

/// A line for /bin/sh that sends a bundle to a host and installs it there; `way` (such as ssh and a
/// host) is the command that runs the installation on the host; empty: on this host. The
/// installation is atomic: the files are checked and then appear all at once, and replace a bundle
/// that is not complete, so several installations may run at the same time. The line prints the
/// path of the cache, or one line with an error.
std::string send_line(const WorkerBundle& bundle, const std::vector<std::string>& way);

/// Installs the bundle on this host, unless it is installed already. Returns the cache.
Expected<std::filesystem::path> install_here(const WorkerBundle& bundle);

}  // namespace swarmsmith
