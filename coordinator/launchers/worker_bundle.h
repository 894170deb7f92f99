#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A worker with loader and libraries of its own, for hosts where nothing is installed:
/// packaging/bundle makes its archive.
struct WorkerBundle {
  std::string architecture;       ///< as `uname -m` has it
  std::filesystem::path archive;  ///< FOLDER/NAME.tar.xz, with the folder NAME in it
  std::string folder;             ///< its name in caches: NAME and the begin of the SHA-256

  friend bool operator==(const WorkerBundle&, const WorkerBundle&) = default;
};

/// Those of this version, one an architecture: in the folder that SWARMSMITH_BUNDLES names, else in
/// ../bundle (of a build) or ../share/swarmsmith, seen from the folder of this program. Errors:
/// there is none, an archive is damaged, or xz is missing.
Expected<std::vector<WorkerBundle>> find_bundles();

/// Exit codes of `start_words`: no bundle is for that host's architecture; the one that is, by its
/// place among them, is not in the cache, or not whole.
constexpr int kNoBundle = 90;
constexpr int kNotInCache = 91;  ///< and the place

/// The words that start the worker of the bundle that a host needs, from its cache
/// (~/.cache/swarmsmith, or in XDG_CACHE_HOME), or from `cache`. If it is not there they write one
/// line with the host's architecture, and end with one of the codes above.
std::vector<std::string> start_words(const std::vector<WorkerBundle>& bundles,
                                     const std::filesystem::path& cache,
                                     const std::vector<std::string>& arguments);

/// A line for /bin/sh that sends a bundle to what installs it, which `way` (such as ssh and a host)
/// takes to where they run; empty: here. Installed is what has arrived as a whole, or nothing: its
/// files are checked, and then appear at once, in place of those of a bundle that is not whole. So
/// others may do the same at the same time. Writes the path of the cache, or one line why not.
std::string send_line(const WorkerBundle& bundle, const std::vector<std::string>& way);

/// Does so on this host, if it is not there yet. Returns the cache.
Expected<std::filesystem::path> install_here(const WorkerBundle& bundle);

}  // namespace swarmsmith
