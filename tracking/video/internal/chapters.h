#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// The recordings in a folder that are chapters of one film: videos, or parts of a bag, in the
/// order of their names. Nothing when the folder has images, or none of these.
std::optional<std::vector<std::string>> chapters_in(const std::string& folder);

/// Their frames one after the other. A chapter whose clock begins anew goes on an interval after
/// the one before; chapters whose clock goes on keep their times, and one that begins before
/// the last one ended is E_TIMESTAMPS. All have one size. `word`: as the folder was named.
Expected<std::unique_ptr<FrameSource>> open_chapters(const std::string& word,
                                                     const std::vector<std::string>& files,
                                                     const std::string& topic);

}  // namespace swarmsmith
