#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// Values as TOML, and the lines of a file. Normalised texts and the lists of deciding values are
/// both made from them, so that they cannot disagree.

struct SectionLine {
  std::string key;
  std::string value;    ///< as TOML
  bool decides = true;  ///< whether another value gives another answer
};

struct Section {
  std::string header;  ///< "[campaign]", "[[mission]]", "[mission.arena]"; empty for the top
  std::string prefix;  ///< of the keys in the deciding list: "mission.aggregation.arena."
  std::vector<SectionLine> lines;
};

/// The sections as a file, each header with an empty line before it.
std::string text_of(const std::vector<Section>& sections);

/// The text in double quotes, with the escapes that TOML and JSON both need.
std::string quoted_text(std::string_view text);

/// The shortest number that reads back to the same bits: 5, 0.25, 1.5e+20.
std::string number_text(double value);

inline std::string flag_text(bool flag) {
  return flag ? "true" : "false";
}

/// The items' texts, separated by commas.
template <class Items, class Text>
std::string list_of(const Items& items, const Text& text_of) {
  std::string text;
  for (const auto& item : items)
    text += (text.empty() ? "" : ", ") + text_of(item);
  return text;
}

}  // namespace swarmsmith
