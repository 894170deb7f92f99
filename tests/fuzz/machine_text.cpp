#include "sim/control/controller.h"
#include "sim/control/flavour.h"
#include "sim/files/machine_file.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

/// Control software as text, in every flavour: refused with a reason and a place, or a machine,
/// tree or network that the flavour takes and whose printed text reads back as the same.
void read_text(std::string_view text) {
  for (const Flavour* flavour : all_flavours()) {
    const auto controller = parse_controller(text, *flavour);
    if (!controller) {
      require(!controller.error().message.empty(), "a refusal has a sentence");
      continue;
    }
    require(!check(*controller, *flavour), "what is read is in the flavour's limits");
    const std::string printed = print_controller(*controller, *flavour);
    const auto again = parse_controller(printed, *flavour);
    require(again.has_value() && *again == *controller, "what is printed reads back as the same");
    require(print_controller(*again, *flavour) == printed, "the printed text is canonical");
  }
}

}  // namespace

/// The text of a machine, and a file of such texts and genomes.
void run(std::string_view input) {
  read_text(input);
  const auto filed = parse_machine_file(input, "machines");
  if (!filed) {
    require(!filed.error().empty(), "a refusal has a sentence");
    return;
  }
  for (const FiledMachine& machine : *filed) {
    require(machine.name.find("--") != 0, "a name is not an option");
    read_text(machine.text);
  }
}

}  // namespace swarmsmith::fuzz
