#pragma once

#include <string>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A page of a PDF as a printer would make it: gray pixels, row by row.
struct PrintedPage {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> gray;
};

/// The pages of a PDF at so many pixels an inch, by the program pdftocairo of the Debian package
/// poppler-utils; Unavailable when that is not there.
Expected<std::vector<PrintedPage>> printed_pages(const std::string& pdf, int dpi);

/// Width and height of a page of a PDF, mm.
struct PageSize {
  double width_mm = 0;
  double height_mm = 0;
};
/// Of each page, by the program pdfinfo of the same package; Unavailable when that is not there.
Expected<std::vector<PageSize>> page_sizes(const std::string& pdf);

}  // namespace swarmsmith
