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

/// The context for which a machine was designed. The text of a machine does not contain it, and has
/// another meaning under another flavour; so a file gives it before the text, as TOML in lines that
/// begin with `#:` (docs/machines.md). Missing values are empty.
struct MachineHead {
  std::string flavour;
  const Flavour* own_flavour = nullptr;  ///< see kept_flavour; null: built-in
  std::optional<TurnClock> turn_clock;
  std::optional<Profile> profile;
  std::optional<MissionEntry> mission;
  std::string seeds;  ///< of its tests, in the format of `--seeds`: 1,4,7-9
  std::string method;
  std::string design;     ///< d3
  std::string candidate;  ///< c812
  std::string campaign;   ///< digest of the campaign that produced it

  friend bool operator==(const MachineHead&, const MachineHead&) = default;
};

/// A machine in a file.
struct FiledMachine {
  MachineHead head;
  std::string name;   ///< the part of the line before the text; may be empty
  std::string text;   ///< in the text grammar
  std::string place;  ///< file:line
};

/// The machines of a file, at least one, or all errors in the file. A machine begins with
/// `--nstates` or `--fsm-config`, a tree with `--nroot`, `--rootnode` or `--bt-config`, a network
/// with `--network`; a name without options may precede it on the line. The text continues in lines
/// that begin with `--`. A genome extends from `genomestart` to `genomeend`. A head belongs to the
/// next machine. Other lines that begin with #, and lines in /* */, are ignored. An error that
/// affects many lines is reported once, and a file of the wrong kind gives a single error. `file`
/// is only the name in error messages; it is not opened.
tl::expected<std::vector<FiledMachine>, std::vector<Error>> parse_machine_file(
    std::string_view text, const std::filesystem::path& file);

/// The lines of the head, which parse_machine_file reads back. Built-in flavours, missions and
/// profiles are written by name, others with all their keys.
std::string head_text(const MachineHead& head);

}  // namespace swarmsmith
