#pragma once

#include <functional>
#include <string>
#include <vector>

#include "console/output.h"
#include "tracking/calibration/solve_offset.h"
#include "tracking/rig/rig.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

/// One of the sources given on the command line: a picture, a folder of pictures, a video, a bag or
/// a camera.
struct PictureSource {
  std::string word;
  bool is_video = false;  ///< its frames are similar to each other
};

/// Called with each frame; returns false if no more frames of this source are needed.
using OnPicture = std::function<Expected<bool>(const PictureSource& source, const FrameSource& of)>;

/// Reads the frames of all sources in turn; E_CALIB_SIZE if their sizes differ. Shows the progress
/// on standard error.
Expected<void> for_each_picture(const std::vector<std::string>& words, const OnPicture& look,
                                Output& output);

/// The path of a tag in a video, from observe() and the plane at the tag's height.
Expected<std::vector<TagSample>> tag_path(const std::string& video, const Rig& rig,
                                          const CameraSetup& camera, const RobotSetup& robot,
                                          Output& output);

/// The camera with this name, or the only one if the name is empty. E_CONFIG lists the known
/// cameras.
Expected<CameraSetup> camera_of(const Rig& rig, const std::string& name,
                                const std::string& option = "--camera");

/// The path of a file that an arena file names, relative to the current folder.
std::string beside(const std::string& arena_file, const std::string& file);

/// The current time in the format of calibration files: "2026-11-21T14:03:00Z".
std::string utc_now();

/// Prints notes about a usable calibration.
void print_cautions(Output& output, const std::vector<std::string>& cautions);

}  // namespace swarmsmith
