#include "sim/files/color_text.h"

#include <vector>

#include "base/suggestion.h"
#include "sim/mission/colors.h"

namespace swarmsmith {

std::string color_key(Rgb color) {
  const std::string text = color_text(color);
  return text.front() == '#' ? "\"" + text + "\"" : text;
}

std::string no_such_color(const std::string& text) {
  std::vector<std::string> names;
  names.reserve(std::size(kNamedColors));
  for (const NamedColor& named : kNamedColors)
    names.emplace_back(named.name);
  return "there is no colour \"" + text + "\"" + did_you_mean(text, names) +
         "; known are: " + joined(names) + ", \"#rrggbb\"";
}

}  // namespace swarmsmith
