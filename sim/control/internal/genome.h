#pragma once

#include <span>
#include <string_view>

#include "base/expected.h"
#include "sim/control/internal/fields.h"
#include "sim/control/network.h"

namespace swarmsmith {

/// How a genome begins, and a network's text that is one.
inline constexpr std::string_view kGenomeStart = "genomestart";

/// Reads a genome as NEAT 1.2.1 writes it, and with it the programs of EvoStick, CMA-ES and xNES
/// (docs/methods.md): nodes, and genes between them, in any order. Only networks without a hidden
/// layer and with the inputs rm1.2 or rm1.1 are read; a gene that is disabled or not there counts
/// 0. `tokens` begins with kGenomeStart and ends with the one of the end.
Expected<Network> read_genome(std::span<const Token> tokens);

}  // namespace swarmsmith
