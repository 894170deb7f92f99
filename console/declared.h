#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/text/json.h"

namespace CLI {
class App;
}

namespace swarmsmith {

/// An option or a word of a command, as the command has declared it.
struct DeclaredOption {
  std::vector<std::string> names;  ///< "-o", "--output"; or the name of a word: "FILE"
  bool is_word = false;
  std::string value;  ///< what stands for its value in the help: "FILE"; empty: a flag or a word
  /// What the value is, for completion: "PROFILE|FILE" is a profile or a file.
  std::string kind;
  std::string help;
  std::vector<std::string> choices;
  bool required = false;
  bool repeats = false;

  bool takes_value() const { return is_word || !kind.empty(); }
};

/// All that the parser has but what is hidden from its help, in the order of declaration.
std::vector<DeclaredOption> declared_options(const CLI::App& app);

/// The member of a command that lists them as JSON: names, word, value, help, choices, required,
/// repeats.
JsonPiece declared_json(const std::vector<DeclaredOption>& options);

}  // namespace swarmsmith
