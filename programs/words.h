#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A text taken apart as a shell does it, without one.
struct Words {
  std::vector<std::string> words;
  /// The first character that means something to a shell and was not quoted: only a shell can say
  /// what the words are, and `words` is empty.
  std::optional<char> needs_shell;

  friend bool operator==(const Words&, const Words&) = default;
};

/// Blanks and tabs separate words; '...' is verbatim; in "..." a backslash takes the meaning of
/// " \ $ ` and newline; elsewhere of any character. Errors, with the byte (from 1) in `where`: a
/// quote that is not closed, a backslash at the end, a NUL byte.
/// Source: POSIX.1-2017, Shell Command Language, 2.2 and 2.3.
Expected<Words> split_words(std::string_view text);

/// The text as one word of a shell: in single quotes, those in it taken out.
std::string shell_quoted(std::string_view text);

}  // namespace swarmsmith
