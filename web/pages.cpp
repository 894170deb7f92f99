#include "web/pages.h"

#include <array>

#if SWARMSMITH_HAS_PAGES
extern "C" {
extern const char swarmsmith_page_code_begin;
extern const char swarmsmith_page_code_end;
extern const char swarmsmith_page_style_begin;
extern const char swarmsmith_page_style_end;
extern const char swarmsmith_page_index_begin;
extern const char swarmsmith_page_index_end;
extern const char swarmsmith_page_icon_begin;
extern const char swarmsmith_page_icon_end;
}
#endif

namespace swarmsmith {

std::span<const PageFile> page_files() {
#if SWARMSMITH_HAS_PAGES
  static const std::array<PageFile, 4> kFiles{
      {{"/",
        "text/html; charset=utf-8",
        {&swarmsmith_page_index_begin, &swarmsmith_page_index_end}},
       {"/main.js",
        "text/javascript; charset=utf-8",
        {&swarmsmith_page_code_begin, &swarmsmith_page_code_end}},
       {"/style.css",
        "text/css; charset=utf-8",
        {&swarmsmith_page_style_begin, &swarmsmith_page_style_end}},
       {"/favicon.svg",
        "image/svg+xml",
        {&swarmsmith_page_icon_begin, &swarmsmith_page_icon_end}}}};
  return kFiles;
#else
  return {};
#endif
}

}  // namespace swarmsmith
