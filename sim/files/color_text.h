#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/control/reference_model.h"

namespace swarmsmith {

/// A colour's name, `grey` for `gray`, or "#rrggbb".
std::optional<Rgb> parse_color(std::string_view text);

/// The name when the colour has one, else "#rrggbb".
std::string color_text(Rgb color);

/// The colour as a TOML key: names are bare, numbers need quotes.
std::string color_key(Rgb color);

/// The sentence about a text that is no colour: a likely one, and what may be written.
std::string no_such_color(const std::string& text);

}  // namespace swarmsmith
