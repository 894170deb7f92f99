#pragma once

#include <functional>
#include <string>
#include <vector>

#include "console/output.h"
#include "tracking/calibration/solve_offset.h"
#include "tracking/rig/rig.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// Pictures of several words, each a picture, a folder of pictures, a video, a bag or a camera.
struct PictureSource {
  std::string word;
  bool is_video = false;  ///< its frames resemble each other
};

/// What is done with a frame; false: enough of this word.
using OnPicture = std::function<Expected<bool>(const PictureSource& source, const FrameSource& of)>;

/// Frames of all words in turn; E_CALIB_SIZE when their sizes differ. Counts on the error stream.
Expected<void> for_each_picture(const std::vector<std::string>& words, const OnPicture& look,
                                Output& output);

/// A tag's path in a video, by observe() and the plane of the tag's height.
Expected<std::vector<TagSample>> tag_path(const std::string& video, const Rig& rig,
                                          const CameraSetup& camera, const RobotSetup& robot,
                                          Output& output);

/// The camera of a name, or the only one when the name is empty. E_CONFIG lists the known ones.
Expected<CameraSetup> camera_of(const Rig& rig, const std::string& name,
                                const std::string& option = "--camera");

/// A file that an arena file names, from where this program runs.
std::string beside(const std::string& arena_file, const std::string& file);

/// Now, as calibrations say when they were made: "2026-11-21T14:03:00Z".
std::string utc_now();

/// Prints what a person should know of a calibration that is fit.
void print_cautions(Output& output, const std::vector<std::string>& cautions);

}  // namespace swarmsmith
