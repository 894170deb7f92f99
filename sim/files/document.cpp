#include "sim/files/document.h"

#include <toml++/toml.h>

#include <array>

namespace swarmsmith {
namespace {

/// The parser counts lines and columns from 1, as editors do.
Place place_of(const toml::source_region& region) {
  return {static_cast<std::uint32_t>(region.begin.line),
          static_cast<std::uint32_t>(region.begin.column)};
}

/// Copies the parser's tree.
Node converted(const toml::node& node) {
  const Place place = place_of(node.source());
  if (const auto* flag = node.as_boolean()) return {flag->get(), place};
  if (const auto* integer = node.as_integer()) return {integer->get(), place};
  if (const auto* real = node.as_floating_point()) return {real->get(), place};
  if (const auto* text = node.as_string()) return {text->get(), place};
  if (const auto* array = node.as_array()) {
    Array items;
    for (const toml::node& item : *array)
      items.items.push_back(converted(item));
    return {std::move(items), place};
  }
  if (const auto* table = node.as_table()) {
    Table entries;
    for (const auto& [key, value] : *table) {
      entries.entries.push_back({std::string(key.str()), place_of(key.source()), converted(value)});
    }
    return {std::move(entries), place};
  }
  if (const auto* date = node.as_date()) {
    const toml::date& value = date->get();
    return {DateOrTime{std::chrono::year_month_day(std::chrono::year(value.year),
                                                   std::chrono::month(value.month),
                                                   std::chrono::day(value.day))},
            place};
  }
  return {DateOrTime{}, place};
}

}  // namespace

std::string_view type_name(const Node& node) {
  static constexpr std::array<std::string_view, 7> kNames = {
      "true or false", "an integer", "a number", "a text", "a list", "a table", "a date or time"};
  return kNames[node.value.index()];
}

std::string to_string(std::string_view file, Place place) {
  std::string text(file);
  if (place.line > 0) {
    text += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  }
  return text;
}

Expected<Node> parse_document(std::string_view text, std::string_view file) {
  try {
    return converted(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    return bad_input("this is no TOML: " + std::string(error.description()),
                     to_string(file, place_of(error.source())));
  }
}

}  // namespace swarmsmith
