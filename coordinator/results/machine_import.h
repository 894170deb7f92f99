#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/text/csv.h"
#include "coordinator/results/import_words.h"
#include "coordinator/results/imported_world.h"
#include "coordinator/results/known_designs.h"
#include "sim/control/flavour.h"
#include "storage/store_at_rest.h"

namespace swarmsmith {

/// A machine that was designed elsewhere, as read from a file.
struct MachineText {
  std::string name;                       ///< may be empty
  std::string mission;                    ///< the mission's name in the file; may be empty
  std::string method;                     ///< may be empty
  std::string flavour;                    ///< from the file's head; may be empty
  const Flavour* own_flavour = nullptr;   ///< from the head, see kept_flavour; null: built in
  std::string text;                       ///< a text of the grammar
  std::string place;                      ///< file:line
  std::optional<MissionEntry> described;  ///< the mission that the file's head describes
  std::optional<Profile> profile;         ///< from the file's head
};

/// Reads the machines of a file with sim/files/machine_file.h.
OrErrors<std::vector<MachineText>> read_machine_lines(std::string_view text,
                                                      const std::string& file);

/// Reads the columns `fsm`, `fsm_config` or `machine`; `fsm_id` or `name`, `mission`, `method` and
/// `flavour` are optional and may be empty.
OrErrors<std::vector<MachineText>> read_machine_table(const CsvTable& table);

/// The flavour that all machines share: that of their heads, and `said`, if given, for machines
/// without one. BadInput if they differ, or if there is no flavour.
Expected<Flavour> flavour_of(const std::vector<MachineText>& machines,
                             const std::optional<Flavour>& said);

/// Whether a table's columns describe machines.
bool has_machines(const CsvTable& table);

struct MachineImport {
  std::string campaign;  ///< name of the imported campaign
  Flavour flavour;
  MissionWords missions;
  std::string method;                ///< for machines that name none
  std::vector<KnownDesign> designs;  ///< designs in the store
};

/// Makes a campaign with the state "imported": each machine becomes a finished design whose only
/// candidate is its winner. Design ids continue after those of the store; a design with a mission
/// and method that the store already has becomes a further repetition. Missions, profile and
/// flavour that heads or files describe are stored in the campaign's `file` (imported_world.h),
/// unless they are built in under the same names. The campaign's digest covers names, missions,
/// methods, flavour and machines, so that importing the same file again is recognised. Errors: all
/// problems, each with its line.
OrErrors<Addition> import_machines(const std::vector<MachineText>& machines,
                                   const MachineImport& known);

}  // namespace swarmsmith
