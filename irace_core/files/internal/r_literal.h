#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith::r {

/// The number that `text` begins with, as R writes numbers, and how many bytes it takes; none when
/// it does not begin with one. `1e999` is Inf.
struct NumberLiteral {
  Number number;
  std::size_t bytes = 0;
};
NumberLiteral read_number(std::string_view text);

/// The string that `text` begins with (a quote, either kind) and how many bytes it takes. Errors:
/// `where` is the byte in `text`.
struct TextLiteral {
  std::string value;
  std::size_t bytes = 0;
};
Expected<TextLiteral> read_text(std::string_view text);

/// The raw string that `text` begins with, as r"(C:\temp)": nothing when it does not begin with
/// one. Errors as those of read_text.
std::optional<Expected<TextLiteral>> read_raw_text(std::string_view text);

/// Blanks, dashes and quotes that word processors put in place of plain ones.
bool is_typographic(std::string_view character);

/// Length in bytes of the character of UTF-8 that `text` begins with; 1 when it is damaged.
std::size_t character_length(std::string_view text);

}  // namespace swarmsmith::r
