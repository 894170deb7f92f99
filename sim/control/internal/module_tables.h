#pragma once

#include <vector>

#include "sim/control/flavour.h"

namespace swarmsmith {

/// The flavours' tables: modules with their numbers in the text grammar and their parameters.

/// Of `watermelon` and `watermelon-argos3` (rvr-automode facts, section 5; the thesis names the
/// same modules and gives no numbers).
std::vector<ModuleSpec> watermelon_behaviours();

/// rvr-automode facts, section 6.1. `lowest_xi`: 0 in the thesis, 1 in the program (section 9,
/// row 17).
std::vector<ModuleSpec> watermelon_conditions(int lowest_xi);

/// rvr-automode facts, section 6.1; thesis facts, section 7, have the same hues.
std::vector<LabelSpec> watermelon_labels();

/// Of `chocolate` (thesis facts, section 8: the e-puck's numbers).
std::vector<ModuleSpec> chocolate_behaviours();

/// The first six of `watermelon`, xi from 0 (thesis facts, sections 6.1 and 8).
std::vector<ModuleSpec> chocolate_conditions();

}  // namespace swarmsmith
