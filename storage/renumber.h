#pragma once

#include <cstdint>

#include "storage/rows.h"

namespace swarmsmith {

/// How far the ids of one campaign's rows move when it comes into a store that holds others, or,
/// with negative numbers, when it is looked at as if it were alone.
struct Shift {
  std::int64_t designs = 0;  ///< candidates move with their designs
  std::int64_t workers = 0;
  std::int64_t commands = 0;
};

/// The row with all its ids moved; an id that says "none" stays none.
Row shifted(Row row, const Shift& shift);

EvaluationKey shifted(EvaluationKey key, const Shift& shift);

}  // namespace swarmsmith
