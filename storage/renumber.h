#pragma once

#include <cstdint>

#include "storage/rows.h"

namespace swarmsmith {

/// What is added to the ids of a campaign's rows when the campaign is copied into a store with
/// other campaigns. The numbers are negative when the campaign is read as if it were alone in its
/// store.
struct Shift {
  std::int64_t designs = 0;  ///< the ids of candidates follow from those of their designs
  std::int64_t workers = 0;
  std::int64_t commands = 0;
};

/// The row with all its ids shifted; an id that means "none" stays as it is.
Row shifted(Row row, const Shift& shift);

EvaluationKey shifted(EvaluationKey key, const Shift& shift);

}  // namespace swarmsmith
