#include "cli/replay/machine_argument.h"

#include <utility>

#include "base/text/whole_file.h"
#include "cli/output/query_output.h"
#include "console/terminal.h"
#include "sim/files/machine_file.h"

namespace swarmsmith::cli {
namespace {

/// The text without blanks at both ends.
std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// The name from the origin in the machine's head.
std::string name_of(const FiledMachine& machine) {
  const MachineHead& head = machine.head;
  if (!machine.name.empty() || head.candidate.empty()) return machine.name;
  return (head.design.empty() ? "" : head.design + "-") + head.candidate;
}

Expected<std::vector<NamedMachine>> machines_of_file(const std::string& file, Output& output) {
  if (is_database(file)) {
    return bad_input("this is a store; name one of its candidates, c812, with --store", file);
  }
  const auto text = read_file(file, "machine");
  if (!text && text.error().kind == ErrorKind::NotFound) {
    return bad_input(
        "not a machine: expected a text that begins with --nstates, --nroot or --network, a file "
        "that exists, or a candidate such as c812",
        file);
  }
  if (!text) return Unexpected(text.error());
  auto filed = parse_machine_file(*text, file);
  if (!filed) {
    for (std::size_t i = 0; i + 1 < filed.error().size(); ++i)
      print_error(output, filed.error()[i]);
    return Unexpected(filed.error().back());
  }
  std::vector<NamedMachine> machines;
  for (FiledMachine& from : *filed) {
    NamedMachine machine{.text = std::move(from.text), .name = name_of(from), .place = from.place};
    MachineHead& head = from.head;
    if (head.mission) machine.mission = CampaignMission{std::move(*head.mission), {}};
    machine.flavour = std::move(head.flavour);
    machine.own_flavour = head.own_flavour;
    machine.turn_clock = head.turn_clock;
    machine.profile = std::move(head.profile);
    machine.seeds = std::move(head.seeds);
    machines.push_back(std::move(machine));
  }
  return machines;
}

}  // namespace

bool is_candidate(const std::string& word) {
  return word.size() > 1 && word.size() < 19 && word.front() == 'c' &&
         word.find_first_not_of("0123456789", 1) == std::string::npos;
}

Expected<NamedMachine> machine_of_candidate(StoreReader& store, const DesignWorlds& worlds,
                                            CandidateId candidate) {
  const auto rows = select(store, "SELECT fsm_config FROM v_candidates WHERE candidate = " +
                                      std::to_string(candidate.value));
  if (!rows) return Unexpected(rows.error());
  if (rows->cells.empty()) {
    return unexpected(ErrorKind::NotFound, "the store has no candidate " + to_string(candidate));
  }
  NamedMachine machine{.text = rows->cells.front().front().text, .candidate = candidate};
  auto world = worlds.of(design_of(candidate));
  if (!world || !*world) return machine;  // file of another version: flags must give the settings
  if ((*world)->has_parameters) {
    return bad_input(to_string(candidate) +
                     " is a configuration of the method's parameter file, not a machine");
  }
  machine.design_mission = (*world)->design.mission;
  machine.mission = std::move((*world)->mission);
  machine.flavour = std::move((*world)->flavour);
  machine.own_flavour = (*world)->own_flavour;
  machine.turn_clock = (*world)->turn_clock;
  machine.profile = std::move((*world)->profile);
  machine.further_profiles = std::move((*world)->further_profiles);
  return machine;
}

Expected<std::vector<NamedMachine>> find_machines(const std::string& word,
                                                  const StoreArgument& store, Output& output) {
  const std::string text = trimmed(word);
  if (text.starts_with("--")) return std::vector{NamedMachine{.text = text}};
  if (!is_candidate(text)) return machines_of_file(text, output);
  const auto reader = store.open();
  if (!reader) return Unexpected(reader.error());
  const auto worlds = DesignWorlds::read(**reader);
  if (!worlds) return Unexpected(worlds.error());
  auto machine = machine_of_candidate(**reader, *worlds, {std::stoll(text.substr(1))});
  if (!machine) return Unexpected(machine.error());
  return std::vector{std::move(*machine)};
}

}  // namespace swarmsmith::cli
