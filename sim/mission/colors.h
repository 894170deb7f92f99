#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "sim/control/reference_model.h"

namespace swarmsmith {

/// A floor colour with a name that files use.
struct NamedColor {
  std::string_view name;
  Rgb color;
};

/// The colours of the labeler (thesis facts, section 4), each channel fully on or off, and of the
/// base floor.
inline constexpr std::array<NamedColor, 7> kNamedColors = {{{"black", {0, 0, 0}},
                                                            {"gray", {127, 127, 127}},
                                                            {"white", {255, 255, 255}},
                                                            {"red", {255, 0, 0}},
                                                            {"green", {0, 255, 0}},
                                                            {"blue", {0, 0, 255}},
                                                            {"yellow", {255, 255, 0}}}};

/// The colour with this name, if there is one.
std::optional<Rgb> color_from_name(std::string_view name);

/// Parses a colour's name, `grey` for `gray`, or "#rrggbb".
std::optional<Rgb> parse_color(std::string_view text);

/// The name of the colour if it has one, else "#rrggbb".
std::string color_text(Rgb color);

}  // namespace swarmsmith
