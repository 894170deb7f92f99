#pragma once

#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "console/declared.h"

namespace swarmsmith {

/// The possible endings of a command line that is being typed.
struct Offer {
  struct Word {
    std::string text;
    std::string meaning;  ///< a few words, or empty
  };
  /// The files that the shell should also list.
  enum class Files { None, Folders, Stores, All };

  std::vector<Word> words;
  Files files = Files::None;
};

/// Adds values of one kind ("DESIGN") that only the program knows. `words` are the complete
/// arguments of the command. The function prints nothing, and ignores errors.
using OfferValues = void (*)(std::string_view kind, std::span<const std::string> words,
                             Offer& offer);

/// The possible next arguments after the complete ones; `begin` is the part that is already typed.
Offer offer_next(const std::vector<DeclaredOption>& options, std::span<const std::string> words,
                 std::string_view begin, OfferValues values);

/// Writes the offer for the shells' scripts: a line WORD, tab, MEANING for each word with this
/// beginning; then the kind of files to list: `:files`, `:stores` or `:folders`.
void write_offer(std::ostream& out, const Offer& offer, std::string_view begin);

/// Joins the words as a shell gives them: bash cuts `--option=value` into three. The last word is
/// the one being typed. Never empty.
std::vector<std::string> typed_words(std::span<const std::string> given);

}  // namespace swarmsmith
