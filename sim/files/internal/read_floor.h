#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "base/text/table_reader.h"
#include "sim/mission/mission.h"

namespace swarmsmith {

/// The source of a floor's images.
struct ImageSource {
  /// The folder of relative file names; without it, images must be in the text and cannot be files.
  std::optional<std::filesystem::path> folder;
  /// See Picture::from_png.
  std::int64_t most_pixels_in_use = Picture::kMostPixelsInUse;
};

/// Reads the keys `floor`, `spots` and `shuffled` of [mission.arena]. `spots` replaces all spots of
/// the preset, because there is no way to remove single ones.
void read_floor(TableReader& arena, const ImageSource& images, Mission& mission);

/// Reads `x`, `y`, `width` and `height`, or `side` for a square.
Rectangle read_rectangle(TableReader& table, bool square);

}  // namespace swarmsmith
