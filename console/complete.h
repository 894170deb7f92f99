#pragma once

#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "console/declared.h"

namespace swarmsmith {

/// What may stand at the end of a command line that is being typed.
struct Offer {
  struct Word {
    std::string text;
    std::string meaning;  ///< half a sentence, or empty
  };
  /// Which files the shell shall list as well.
  enum class Files { None, Folders, Stores, All };

  std::vector<Word> words;
  Files files = Files::None;
};

/// Adds values of one kind ("DESIGN") which only a program knows. `words` are those of the command
/// that are whole. It says nothing, whatever is wrong.
using OfferValues = void (*)(std::string_view kind, std::span<const std::string> words,
                             Offer& offer);

/// What may follow the whole words of a command, as its next word; `begin` of it is typed.
Offer offer_next(const std::vector<DeclaredOption>& options, std::span<const std::string> words,
                 std::string_view begin, OfferValues values);

/// For the shells' scripts: a line WORD, tab, MEANING for each word that begins so; then what files
/// to list: `:files`, `:stores` or `:folders`.
void write_offer(std::ostream& out, const Offer& offer, std::string_view begin);

/// The words as a shell gives them; the last one is being typed: bash cuts `--option=value` in
/// three. Never empty.
std::vector<std::string> typed_words(std::span<const std::string> given);

}  // namespace swarmsmith
