#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "sim/control/flavour.h"
#include "sim/engine/profile.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {

/// What a machine was designed for. A text of the grammar does not say it, and means something else
/// under another flavour; so a file has it before the text, as TOML in lines that begin with `#:`
/// (docs/machines.md). Missing values are empty.
struct MachineHead {
  std::string flavour;
  const Flavour* own_flavour = nullptr;  ///< see kept_flavour; null: built in
  std::optional<TurnClock> turn_clock;
  std::optional<Profile> profile;
  std::optional<MissionEntry> mission;
  std::string seeds;  ///< of its tests, as in `--seeds`: 1,4,7-9
  std::string method;
  std::string design;     ///< d3
  std::string candidate;  ///< c812
  std::string campaign;   ///< digest of the campaign that made it

  friend bool operator==(const MachineHead&, const MachineHead&) = default;
};

/// A machine of a file.
struct FiledMachine {
  MachineHead head;
  std::string name;   ///< what stands before the text on its line; may be empty
  std::string text;   ///< of the grammar
  std::string place;  ///< file:line
};

/// The machines of a file, at least one, or everything that is wrong with it. A machine begins with
/// `--nstates` or `--fsm-config`, a tree with `--nroot`, `--rootnode` or `--bt-config`, a network
/// with `--network`, after a name or none, and goes on in lines that begin with `--`; a name has no
/// options. A genome goes from `genomestart` to `genomeend`. A head is of the next machine. Other
/// lines that begin with #, and those in /* */, say nothing. What is wrong with many lines is said
/// once, and a file of another kind is one error. `file` gives the name for errors, and is not
/// read.
tl::expected<std::vector<FiledMachine>, std::vector<Error>> parse_machine_file(
    std::string_view text, const std::filesystem::path& file);

/// The head's lines, which parse_machine_file reads back. Flavours, missions and profiles that are
/// built in are named, others are there with all their keys.
std::string head_text(const MachineHead& head);

}  // namespace swarmsmith
