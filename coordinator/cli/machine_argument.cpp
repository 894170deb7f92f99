#include "coordinator/cli/machine_argument.h"

#include <fstream>

#include "coordinator/campaign/campaign_file.h"
#include "coordinator/cli/query_output.h"

namespace swarmsmith::cli {
namespace {

/// Without blanks at both ends.
std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// c and digits; a file of such a name is written ./c12.
bool is_candidate(const std::string& word) {
  return word.size() > 1 && word.size() < 19 && word.front() == 'c' &&
         word.find_first_not_of("0123456789", 1) == std::string::npos;
}

/// Comments and line breaks are what `export` and people put in.
Expected<NamedMachine> machine_of_file(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) {
    return bad_input(
        "this is no machine: neither a text that begins with --nstates, nor a file, "
        "nor a candidate such as c812",
        file);
  }
  std::string machine;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
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

/// The store's own campaign says on what the candidate was tried.
Expected<NamedMachine> machine_of_store(const std::string& id, const StoreArgument& argument) {
  const auto store = argument.open();
  if (!store) return Unexpected(store.error());
  const auto rows =
      select(**store,
             "SELECT c.fsm_config, d.mission, d.method, d.design FROM v_candidates AS "
             "c JOIN v_designs AS d ON d.design = c.design "
             "WHERE c.candidate = " +
                 id.substr(1));
  if (!rows) return Unexpected(rows.error());
  if (rows->cells.empty()) {
    return unexpected(ErrorKind::NotFound, "the store has no candidate " + id);
  }
  const auto& cells = rows->cells.front();
  NamedMachine machine{.text = cells[0].text};
  const auto stored = (*store)->campaign_of({std::stoll(cells[3].text)});
  if (!stored) return Unexpected(stored.error());
  const auto campaign = parse_campaign(stored->row.file, "campaign.toml");
  if (!campaign) return machine;  // of another method, imported: flags must say it
  if (!campaign->target) machine.profile = campaign->profile;
  for (const CampaignMission& mission : campaign->missions) {
    if (campaign->target) break;  // its world is its programs'
    if (mission.mission.name == cells[1].text) machine.mission = mission;
  }
  for (const Method& method : campaign->methods) {
    if (method.name != cells[2].text) continue;
    if (!method.parameters.empty()) {
      return bad_input(id + " is a configuration of the method's parameter file, and no machine");
    }
    machine.flavour = method.flavour;
    machine.turn_clock = method.turn_clock;
  }
  return machine;
}

}  // namespace

Expected<NamedMachine> find_machine(const std::string& word, const StoreArgument& store) {
  const std::string text = trimmed(word);
  if (text.starts_with("--")) return NamedMachine{.text = text};
  if (is_candidate(text)) return machine_of_store(text, store);
  return machine_of_file(text);
}

}  // namespace swarmsmith::cli
