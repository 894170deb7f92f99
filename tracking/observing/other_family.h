#pragma once

#include <optional>
#include <string>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// A sentence about tags in a picture that belong to other families than `own`, if there are any.
std::optional<std::string> other_family(const std::string& own, const GrayImage& image);

}  // namespace swarmsmith
