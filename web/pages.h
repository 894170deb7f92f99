#pragma once

#include <span>
#include <string_view>

namespace swarmsmith {

/// A file of the dashboard, as browsers load it.
struct PageFile {
  std::string_view path;    ///< "/main.js"; "/" is the page itself
  std::string_view type;    ///< "text/javascript; charset=utf-8"
  std::string_view packed;  ///< its bytes, by gzip
};

/// All of them; none in a program that was built without pages (SWARMSMITH_DASHBOARD).
std::span<const PageFile> page_files();

}  // namespace swarmsmith
