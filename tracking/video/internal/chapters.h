#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// The recordings in a folder that are the chapters of one film: videos, or parts of a bag, in the
/// order of their names. Nothing if the folder contains images, or no recordings.
std::optional<std::vector<std::string>> chapters_in(const std::string& folder);

/// Reads the frames of all chapters in sequence. If a chapter's clock starts anew, the chapter
/// follows the previous one after one interval; if the clock continues, the times are kept, and a
/// chapter that begins before the end of the previous one is an E_TIMESTAMPS. All chapters have the
/// same size. `word` is the folder as the user named it.
Expected<std::unique_ptr<FrameSource>> open_chapters(const std::string& word,
                                                     const std::vector<std::string>& files,
                                                     const std::string& topic);

}  // namespace swarmsmith
