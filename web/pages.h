#pragma once

#include <span>
#include <string_view>

namespace swarmsmith {

/// A file of the dashboard, as a browser loads it.
struct PageFile {
  std::string_view path;    ///< "/main.js"; "/" is the page itself
  std::string_view type;    ///< "text/javascript; charset=utf-8"
  std::string_view packed;  ///< the contents, compressed by gzip
};

/// All files; empty in a program that was built without pages (SWARMSMITH_DASHBOARD).
std::span<const PageFile> page_files();

}  // namespace swarmsmith
