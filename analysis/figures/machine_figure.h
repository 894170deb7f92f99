#pragma once

#include <string>

#include "analysis/machines/machine_layout.h"
#include "analysis/records/records.h"
#include "sim/control/flavour.h"
#include "sim/control/machine.h"

namespace swarmsmith {

/// A stored machine that can be drawn.
struct StoredMachine {
  Machine machine;
  const Flavour* flavour = nullptr;  ///< never null
};

/// Reads a candidate's text in its design's flavour. Errors: BadInput when it is no machine but a
/// program's configuration, when the store does not say the flavour (with how to make it), or the
/// text is damaged.
Expected<StoredMachine> machine_of(const MachineRecord& candidate);

/// States and transitions, a row each, with values as they are: what a picture of the machine
/// shows.
std::string machine_csv(const StoredMachine& stored);

/// What a picture of it is called: "d1 c812, aggregation, watermelon".
std::string title_of(const MachineRecord& candidate);

}  // namespace swarmsmith
