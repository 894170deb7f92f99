#include "analysis/machines/internal/dot_text.h"

#include "base/shown_text.h"

namespace swarmsmith {

std::string dot_text(std::string_view text) {
  std::string result = "\"";
  for (const char letter : as_shown(text, Layout::Escaped)) {
    if (letter == '"' || letter == '\\') result += '\\';
    result += letter;
  }
  return result + "\"";
}

std::string dot_label(const std::vector<LabelLine>& lines) {
  std::string label = "\"";
  for (std::size_t i = 0; i < lines.size(); ++i)
    label += (i > 0 ? "\\n" : "") + lines[i].text;
  return label + "\"";
}

}  // namespace swarmsmith
