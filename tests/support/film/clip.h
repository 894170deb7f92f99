#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/film/schedule.h"
#include "tests/support/film/virtual_camera.h"

namespace swarmsmith::film {

/// How a clip is kept: a folder of PNG images, MJPEG in .avi (frames at a constant rate, whatever
/// their stamps), H.264 in .mkv, whose frames lie at their stamps.
enum class ClipForm { Folder, Mjpg, H264 };

/// Takes the pictures of a schedule and writes them to `file` (a folder: made anew), with the
/// sidecar FILE.times.csv beside it (for a folder: in the name of the folder) unless `sidecar` is
/// false. Throws std::runtime_error when it cannot be written.
void write_clip(const VirtualCamera& camera, const std::vector<ShotFrame>& frames,
                const std::filesystem::path& file, ClipForm form, double rate_hz, bool sidecar);

/// One picture as PNG.
void write_png(const ColorImage& image, const std::filesystem::path& file);

/// A file's text. Throws std::runtime_error when it cannot be written.
void write_text(const std::filesystem::path& file, const std::string& text);

/// "run01.times.csv" beside "run01.mp4" or the folder "run01".
std::filesystem::path sidecar_of(const std::filesystem::path& clip);

/// Ending of a form's files, with its dot; empty for a folder.
std::string ending_of(ClipForm form);

}  // namespace swarmsmith::film
