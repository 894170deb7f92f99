#include "base/shown_text.h"

#include <string>

#include "base/text/csv.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

/// What the quotes of a field stand for.
std::string unquoted(std::string_view field) {
  if (!field.starts_with('"')) return std::string(field);
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"') ++i;
  }
  return text;
}

}  // namespace

/// Whatever a text is, it is shown without control characters, and a field of a table is not a
/// formula and comes back.
void run(std::string_view input) {
  for (const Layout layout : {Layout::Kept, Layout::Escaped}) {
    const std::string shown = as_shown(input, layout);
    require(as_shown(shown, layout) == shown, "what is shown is shown as it is");
    for (const char byte : shown) {
      const bool breaks = layout == Layout::Kept && (byte == '\n' || byte == '\t');
      const auto code = static_cast<unsigned char>(byte);
      require(breaks || (code >= 0x20 && code != 0x7f), "no control character is shown");
    }
    require(shown.find("\xc2\x9b") == std::string::npos, "nor one of C1");
  }
  const std::string cell = unquoted(csv_field(input));
  require(csv_text(cell) == input, "a field comes back");
  constexpr std::string_view kFormulas = "=@\t\r\n";
  require(cell.empty() || kFormulas.find(cell.front()) == std::string_view::npos,
          "a field is not a formula");
}

}  // namespace swarmsmith::fuzz
