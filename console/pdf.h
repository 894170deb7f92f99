#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// Converts a drawing to PDF of the same size, with text as text, by the program rsvg-convert of
/// the Debian package librsvg2-bin. The same drawing gives the same bytes, because the date in the
/// file is 1970.
///
/// Errors: Unavailable, with the package to install if the program is missing, or with the
/// program's own message if it fails or takes over a minute.
Expected<std::string> pdf_of_svg(std::string_view svg);

/// Converts a drawing to PNG, 300 pixels per inch, on white; in the same way, with the same errors.
Expected<std::string> png_of_svg(std::string_view svg);

/// Converts several drawings, one page each.
Expected<std::string> pdf_of_svgs(std::span<const std::string> pages);

}  // namespace swarmsmith
