#include "sim/control/machine_text.h"

#include "sim/control/flavour.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {

/// Control software as text, in every flavour: refused with a reason and a place, or a machine that
/// the flavour takes and whose printed text reads back as the same.
void run(std::string_view input) {
  for (const Flavour* flavour : all_flavours()) {
    const auto machine = parse_machine(input, *flavour);
    if (!machine) {
      require(!machine.error().message.empty(), "a refusal has a sentence");
      continue;
    }
    require(!check(*machine, *flavour), "what is read is in the flavour's limits");
    const std::string printed = print_machine(*machine, *flavour);
    const auto again = parse_machine(printed, *flavour);
    require(again.has_value() && *again == *machine, "what is printed reads back as the same");
    require(print_machine(*again, *flavour) == printed, "the printed text is canonical");
  }
}

}  // namespace swarmsmith::fuzz
