#include "sim/files/internal/read_color.h"

#include <map>

#include "sim/files/color_text.h"

namespace swarmsmith {

std::optional<Rgb> read_color(TableReader& table, std::string_view key) {
  if (!table.has(key)) {
    table.take(key);
    table.complain(key, table.name() + " needs a `" + std::string(key) + "`");
    return std::nullopt;
  }
  const auto text = table.text(key);
  if (!text) return std::nullopt;
  const auto color = parse_color(*text);
  if (!color) {
    table.complain(key, no_such_color(*text));
  }
  return color;
}

std::vector<std::pair<std::string, Rgb>> read_color_keys(TableReader& table) {
  std::map<std::string, std::pair<std::string, Rgb>> by_name;
  for (const auto& [key, node] : table.take_all()) {
    const auto color = parse_color(key);
    if (!color) {
      table.complain(key, no_such_color(key));
      continue;
    }
    if (!by_name.try_emplace(color_text(*color), key, *color).second) {
      table.complain(key, "the colour " + color_text(*color) + " is given twice");
    }
  }
  std::vector<std::pair<std::string, Rgb>> keys;
  keys.reserve(by_name.size());
  for (auto& [name, key] : by_name)
    keys.push_back(std::move(key));
  return keys;
}

}  // namespace swarmsmith
