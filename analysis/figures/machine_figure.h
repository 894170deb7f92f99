#pragma once

#include <cstdint>
#include <string>

#include "analysis/records/records.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// Control software from a store that can be drawn: a machine, a tree or a network.
struct StoredController {
  Controller controller;
  const Flavour* flavour = nullptr;  ///< never null
};

/// Reads a candidate's text in its design's flavour. Errors: BadInput if it is a program's
/// configuration instead of control software, if the store does not know the flavour (the message
/// says how to add it), or if the text is damaged. `schema` is the store's version; `own` is a
/// flavour that is not built in.
Expected<StoredController> controller_of(const MachineRecord& candidate, std::int64_t schema,
                                         const Flavour* own = nullptr);

/// The same for a store, which may have its own flavours.
Expected<StoredController> controller_of(const MachineRecord& candidate, StoreReader& store);

/// The contents of its picture as a table with exact values: one row for each state and transition,
/// each subtree, or each input.
std::string controller_csv(const StoredController& stored);

/// The title of its picture: "d1 c812, aggregation, watermelon".
std::string title_of(const MachineRecord& candidate);

}  // namespace swarmsmith
