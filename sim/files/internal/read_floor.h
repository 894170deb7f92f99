#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "base/text/table_reader.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// Where the images of a floor come from.
struct ImageSource {
  /// Files of images are relative to it; none: they may not be named, and are in the text.
  std::optional<std::filesystem::path> folder;
  /// See Picture::from_png.
  std::int64_t most_pixels_in_use = Picture::kMostPixelsInUse;
};

/// The keys `floor`, `spots` and `shuffled` of [mission.arena]. Spots replace all of the preset's,
/// since one cannot take away what is not named.
void read_floor(TableReader& arena, const ImageSource& images, Mission& mission);

/// `x`, `y`, `width` and `height`, or for a square `side`.
Rectangle read_rectangle(TableReader& table, bool square);

}  // namespace swarmsmith
