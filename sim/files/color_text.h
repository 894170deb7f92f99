#pragma once

#include <string>

#include "sim/mission/colors.h"

namespace swarmsmith {

/// The colour as a TOML key: names are bare, numbers need quotes.
std::string color_key(Rgb color);

/// The sentence about a text that is not a colour: a likely one, and what may be written.
std::string no_such_color(const std::string& text);

}  // namespace swarmsmith
