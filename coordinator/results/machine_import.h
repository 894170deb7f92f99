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

/// A machine that was designed elsewhere, as a file has it.
struct MachineText {
  std::string name;                       ///< may be empty
  std::string mission;                    ///< as the file calls it; may be empty
  std::string method;                     ///< may be empty
  std::string flavour;                    ///< as its head says; may be empty
  const Flavour* own_flavour = nullptr;   ///< of its head, see kept_flavour; null: built in
  std::string text;                       ///< of the grammar
  std::string place;                      ///< file:line
  std::optional<MissionEntry> described;  ///< the mission that its head holds
  std::optional<Profile> profile;         ///< of its head
};

/// The machines of a file as sim/files/machine_file.h reads it.
OrErrors<std::vector<MachineText>> read_machine_lines(std::string_view text,
                                                      const std::string& file);

/// Columns `fsm`, `fsm_config` or `machine`; `fsm_id` or `name`, `mission`, `method` and `flavour`
/// may be missing or empty.
OrErrors<std::vector<MachineText>> read_machine_table(const CsvTable& table);

/// The flavour of all of them: what their heads say, and `said` of those without one; `said` may be
/// nothing. BadInput when they do not agree, or when it is not given.
Expected<Flavour> flavour_of(const std::vector<MachineText>& machines,
                             const std::optional<Flavour>& said);

/// Whether a table's columns are those of machines.
bool has_machines(const CsvTable& table);

struct MachineImport {
  std::string campaign;  ///< name of the campaign that they become
  Flavour flavour;
  MissionWords missions;
  std::string method;                ///< of machines without one
  std::vector<KnownDesign> designs;  ///< that the store has
};

/// A campaign with the state "imported": each machine a finished design with one candidate, its
/// winner. Designs are numbered after those of the store; a design of a mission and method that the
/// store has is a further repetition. Missions, profile and flavour that heads or files describe
/// are the campaign's `file` (imported_world.h), unless each program knows them by their names. The
/// campaign's digest is one over names, missions, methods, flavour and machines, so that the same
/// file is known again. All that is wrong, with its line.
OrErrors<Addition> import_machines(const std::vector<MachineText>& machines,
                                   const MachineImport& known);

}  // namespace swarmsmith
