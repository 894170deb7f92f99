#include "tracking/video/frame_source.h"

#include <filesystem>
#include <system_error>

#include "tracking/video/internal/bag_file.h"
#include "tracking/video/internal/bag_word.h"
#include "tracking/video/internal/camera_word.h"
#include "tracking/video/internal/image_folder.h"
#include "tracking/video/internal/live_camera.h"
#include "tracking/video/internal/video_file.h"

namespace swarmsmith {

Expected<std::unique_ptr<FrameSource>> FrameSource::open(const std::string& word) {
  std::error_code ignored;
  if (std::filesystem::is_directory(word, ignored)) return open_image_folder(word);
  if (is_image_file(word)) return open_image(word);
  if (is_camera_word(word) && !std::filesystem::exists(word, ignored)) return open_camera(word);
  if (const auto bag = bag_word(word)) return open_bag(*bag);
  return open_video_file(word);
}

std::string file_of_source(const std::string& word) {
  const auto bag = bag_word(word);
  return bag ? bag->file : word;
}

}  // namespace swarmsmith
