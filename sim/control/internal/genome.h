#pragma once

#include <span>
#include <string_view>

#include "base/expected.h"
#include "sim/control/internal/fields.h"
#include "sim/control/network.h"

namespace swarmsmith {

/// The first word of a genome; the text of a network that is a genome begins with it.
inline constexpr std::string_view kGenomeStart = "genomestart";

/// Reads a genome in the format of NEAT 1.2.1, which the programs of EvoStick, CMA-ES and xNES use,
/// too (docs/methods.md): nodes, and genes between them, in any order. It accepts only networks
/// without a hidden layer and with the inputs rm1.2 or rm1.1; a gene that is disabled or missing
/// has weight 0. `tokens` begins with kGenomeStart and ends with the end token.
Expected<Network> read_genome(std::span<const Token> tokens);

}  // namespace swarmsmith
