#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/expected.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith::r {

/// The number at the start of `text`, in R's notation, and its length in bytes, which is 0 if there
/// is no number. `1e999` is Inf.
struct NumberLiteral {
  Number number;
  std::size_t bytes = 0;
};
NumberLiteral read_number(std::string_view text);

/// The string at the start of `text` (in quotes of either kind) and its length in bytes. In errors,
/// `where` is the position of a byte in `text`.
struct TextLiteral {
  std::string value;
  std::size_t bytes = 0;
};
Expected<TextLiteral> read_text(std::string_view text);

/// The raw string at the start of `text`, such as r"(C:\temp)"; nothing if there is none. Errors as
/// in read_text.
std::optional<Expected<TextLiteral>> read_raw_text(std::string_view text);

/// Whether a character is a blank, dash or quote that word processors use instead of a plain one.
bool is_typographic(std::string_view character);

/// Length in bytes of the UTF-8 character at the start of `text`; 1 if it is invalid.
std::size_t character_length(std::string_view text);

}  // namespace swarmsmith::r
