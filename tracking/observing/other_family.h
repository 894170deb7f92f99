#pragma once

#include <optional>
#include <string>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// Tags of other families than this one in a picture, a sentence.
std::optional<std::string> other_family(const std::string& own, const GrayImage& image);

}  // namespace swarmsmith
