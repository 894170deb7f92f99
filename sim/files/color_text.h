#pragma once

#include <string>

#include "sim/mission/colors.h"

namespace swarmsmith {

/// The colour as a TOML key: names are bare, "#rrggbb" is quoted.
std::string color_key(Rgb color);

/// The message about a text that is not a colour: it suggests a similar name, and lists the valid
/// forms.
std::string no_such_color(const std::string& text);

}  // namespace swarmsmith
