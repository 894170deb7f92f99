#include "sim/control/flavour_file.h"
#include "sim/control/flavour_text.h"

#include <string>
#include <vector>

#include "sim/control/behaviours.h"
#include "sim/control/machine_text.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

std::vector<double> lowest(const ModuleSpec& spec) {
  std::vector<double> values;
  for (const ParameterSpec& parameter : spec.parameters)
    values.push_back(parameter.low);
  return values;
}

}  // namespace

/// Flavours are refused with reasons and places, or read to one whose text reads back as the same,
/// and so do machines of its behaviours.
void run(std::string_view input) {
  const auto flavour = parse_flavour(input, "/no-such-folder/mine.toml");
  if (!flavour) return require_reasons(flavour.error());
  const auto again = parse_flavour(flavour_text(*flavour), "mine.toml");
  require(again.has_value(), "what is printed can be read");
  require(*again == *flavour, "what is printed reads back as the same");
  for (const ModuleSpec& spec : flavour->behaviours) {
    const Machine machine{{{make_behaviour(spec.module, lowest(spec)), {}}}};
    const auto read = parse_machine(print_machine(machine, *flavour), *flavour);
    require(read.has_value(), "a machine's text can be read");
    require(*read == machine, "and is the same machine");
  }
}

}  // namespace swarmsmith::fuzz
