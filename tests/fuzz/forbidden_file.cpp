#include "irace_core/files/forbidden_file.h"

#include "irace_core/files/expression_text.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// Clauses that are read read back, line by line, from what is printed.
void run(std::string_view input) {
  const std::vector<std::string> names = {"a", "b", "NumStates", "N0x0", "c", "alpha", "beta"};
  std::vector<Error> warnings;
  const auto clauses = parse_forbidden_file({std::string(input), "f"}, names, warnings);
  if (!clauses) return require_reasons({clauses.error()});
  std::string text;
  for (const Expression& clause : *clauses)
    text += print(clause) + "\n";
  std::vector<Error> none;
  const auto again = parse_forbidden_file({text, "again"}, names, none);
  require(again.has_value() && *again == *clauses, "what is printed reads back as the same");
  require(none.empty(), "what is printed needs no warning");
}

}  // namespace swarmsmith::fuzz
