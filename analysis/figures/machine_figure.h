#pragma once

#include <cstdint>
#include <string>

#include "analysis/records/records.h"
#include "sim/control/controller.h"
#include "sim/control/flavour.h"

namespace swarmsmith {

/// Stored control software that can be drawn: a machine, a tree or a network.
struct StoredController {
  Controller controller;
  const Flavour* flavour = nullptr;  ///< never null
};

/// Reads a candidate's text in its design's flavour. Errors: BadInput when it is not control
/// software but a program's configuration, when the store does not say the flavour (with how to
/// make it), or the text is damaged. `schema` is the
/// store's; `own` a flavour that is not built in.
Expected<StoredController> controller_of(const MachineRecord& candidate, std::int64_t schema,
                                         const Flavour* own = nullptr);

/// The same of a store, which may have flavours of its own.
Expected<StoredController> controller_of(const MachineRecord& candidate, StoreReader& store);

/// What a picture of it shows, with values as they are: a row for each state and transition, each
/// subtree, or each input.
std::string controller_csv(const StoredController& stored);

/// What a picture of it is called: "d1 c812, aggregation, watermelon".
std::string title_of(const MachineRecord& candidate);

}  // namespace swarmsmith
