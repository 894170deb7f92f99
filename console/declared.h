#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/text/json.h"

namespace CLI {
class App;
}

namespace swarmsmith {

/// An option or a positional argument, as declared by its command.
struct DeclaredOption {
  std::vector<std::string> names;  ///< "-o", "--output"; or the name of an argument: "FILE"
  bool is_word = false;
  std::string value;  ///< name of its value in the help: "FILE"; empty for flags and arguments
  /// The kind of the value, for completion: "PROFILE|FILE" is a profile or a file.
  std::string kind;
  std::string help;
  std::vector<std::string> choices;
  bool required = false;
  bool repeats = false;

  bool takes_value() const { return is_word || !kind.empty(); }
};

/// Everything that the parser accepts, except options hidden from its help, in the order of
/// declaration.
std::vector<DeclaredOption> declared_options(const CLI::App& app);

/// The member of a command that lists its options as JSON: names, word, value, help, choices,
/// required, repeats.
JsonPiece declared_json(const std::vector<DeclaredOption>& options);

}  // namespace swarmsmith
