#include "coordinator/cli/machine_argument.h"

#include <fstream>
#include <sstream>

#include "coordinator/cli/query_output.h"
#include "sim/files/file_text.h"

namespace swarmsmith::cli {
namespace {

constexpr std::size_t kMostBytes = 1U << 20U;

/// Without blanks at both ends.
std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// Comments and line breaks are what `export` and people put in.
Expected<NamedMachine> machine_of_file(const std::string& file) {
  if (is_database(file)) {
    return bad_input("this is a store; name one of its candidates, c812, with --store", file);
  }
  if (!std::ifstream(file)) {
    return bad_input(
        "this is no machine: neither a text that begins with --nstates, nor a file, "
        "nor a candidate such as c812",
        file);
  }
  const auto text = read_file(file, "machine", kMostBytes);
  if (!text) return Unexpected(text.error());
  std::istringstream lines(*text);
  std::string machine;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') continue;
    const bool begins = line.starts_with("--nstates") || line.starts_with("--fsm-config");
    if (begins && !machine.empty()) {
      return bad_input("the file holds more than one machine", file + ":" + std::to_string(number));
    }
    machine += (machine.empty() ? "" : " ") + line;
  }
  if (machine.empty()) return bad_input("the file holds no machine", file);
  return NamedMachine{.text = machine};
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
  if (!world || !*world) return machine;  // a file of another version: flags must say it
  if ((*world)->has_parameters) {
    return bad_input(to_string(candidate) +
                     " is a configuration of the method's parameter file, and no machine");
  }
  machine.design_mission = (*world)->design.mission;
  machine.mission = std::move((*world)->mission);
  machine.flavour = std::move((*world)->flavour);
  machine.turn_clock = (*world)->turn_clock;
  machine.profile = std::move((*world)->profile);
  return machine;
}

Expected<NamedMachine> find_machine(const std::string& word, const StoreArgument& store) {
  const std::string text = trimmed(word);
  if (text.starts_with("--")) return NamedMachine{.text = text};
  if (!is_candidate(text)) return machine_of_file(text);
  const auto reader = store.open();
  if (!reader) return Unexpected(reader.error());
  const auto worlds = DesignWorlds::read(**reader);
  if (!worlds) return Unexpected(worlds.error());
  return machine_of_candidate(**reader, *worlds, {std::stoll(text.substr(1))});
}

}  // namespace swarmsmith::cli
