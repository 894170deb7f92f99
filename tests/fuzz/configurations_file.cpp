#include "irace_core/files/configurations_file.h"

#include "irace_core/files/command_line_text.h"
#include "irace_core/files/parameter_file.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

/// The parameters of the golden configurations files.
const ParameterSpace& space() {
  static const ParameterSpace kSpace =
      parse_parameter_file(
          {{"algo \"--algo \" c (a,b,fix me,NA)\nx \"--x \" r (0, 10)\n"
            "n \"--n \" i (1, 100) | algo == \"a\"\nd \"--d \" i (1, n) | algo == \"a\"\n"
            "o \"--o \" o (low,mid,high)\nk \"--k \" c (only)\nkc \"--kc \" c (1) | algo == \"b\"\n"
            "[global]\ndigits = 3\n",
            "p"},
           {},
           {},
           {}})
          ->space;
  return kSpace;
}

}  // namespace

/// Configurations that are read are valid, and read back from what is printed.
void run(std::string_view input) {
  const auto found = parse_configurations_file({std::string(input), "c"}, space());
  if (!found) return require_reasons({found.error()});
  for (const Configuration& configuration : *found) {
    require(space().check(configuration).has_value(), "what is read is valid");
    require(!command_line_text(space(), configuration).empty(), "there is always an argument");
  }
  const auto text = print_configurations_file(space(), *found);
  require(text.has_value(), "the values of this space can be printed");
  const auto again = parse_configurations_file({*text, "again"}, space());
  require(again.has_value() && *again == *found, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
