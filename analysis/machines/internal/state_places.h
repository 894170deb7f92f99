#pragma once

#include <cstddef>

#include "analysis/machines/internal/condition_placing.h"

namespace swarmsmith {

/// Finds places for the states, and for the conditions with `place_conditions`: tries a fixed list
/// of distances between states and keeps the best result. Fills `task.states`.
Placing place_all(PlacingTask& task, std::size_t states);

}  // namespace swarmsmith
