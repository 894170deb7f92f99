#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/expected.h"

namespace swarmsmith {

/// A drawing as PDF of the same size, with text as text, by the program rsvg-convert of the Debian
/// package librsvg2-bin. The same drawing gives the same bytes: the date within is 1970.
///
/// Errors: Unavailable, with what to install when the program is not there, and with its own words
/// when it fails or takes over a minute.
Expected<std::string> pdf_of_svg(std::string_view svg);

/// A drawing as PNG, 300 pixels an inch, on white; the same way, with the same errors.
Expected<std::string> png_of_svg(std::string_view svg);

/// Several drawings, a page each.
Expected<std::string> pdf_of_svgs(std::span<const std::string> pages);

}  // namespace swarmsmith
