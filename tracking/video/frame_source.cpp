#include "tracking/video/frame_source.h"

#include <filesystem>
#include <system_error>

#include "tracking/video/internal/bag_file.h"
#include "tracking/video/internal/bag_parts.h"
#include "tracking/video/internal/bag_word.h"
#include "tracking/video/internal/camera_word.h"
#include "tracking/video/internal/chapters.h"
#include "tracking/video/internal/image_folder.h"
#include "tracking/video/internal/live_camera.h"
#include "tracking/video/internal/mcap_file.h"
#include "tracking/video/internal/rosbag2_file.h"
#include "tracking/video/internal/video_file.h"

namespace swarmsmith {
namespace {

/// A folder with the parts of a bag, and a topic: `run07:/ceiling/image_raw`.
struct BagParts {
  std::string folder;
  std::vector<std::string> files;
  std::string topic;
};

std::optional<BagParts> parts_of_bag(const std::string& word) {
  const std::size_t colon = word.rfind(":/");
  std::error_code ignored;
  if (colon == std::string::npos || std::filesystem::exists(word, ignored)) return std::nullopt;
  const std::string folder = word.substr(0, colon);
  if (!std::filesystem::is_directory(folder, ignored)) return std::nullopt;
  auto files = chapters_in(folder);
  if (!files) return std::nullopt;
  return BagParts{folder, std::move(*files), word.substr(colon + 1)};
}

}  // namespace

Expected<std::unique_ptr<FrameSource>> FrameSource::open(const std::string& word) {
  std::error_code ignored;
  if (const auto parts = check_bag_parts(word); !parts) return Unexpected(parts.error());
  if (std::filesystem::is_directory(word, ignored)) {
    if (const auto chapters = chapters_in(word)) return open_chapters(word, *chapters, {});
    return open_image_folder(word);
  }
  if (is_image_file(word)) return open_image(word);
  if (is_camera_word(word) && !std::filesystem::exists(word, ignored)) return open_camera(word);
  if (const auto bag = bag_word(word)) {
    if (bag->kind == BagWord::Kind::Mcap) return open_mcap(*bag);
    if (bag->kind == BagWord::Kind::Sqlite) return open_rosbag2(*bag);
    return open_bag(*bag);
  }
  if (const auto parts = parts_of_bag(word)) {
    if (const auto whole = check_bag_parts(parts->folder); !whole) return Unexpected(whole.error());
    return open_chapters(word, parts->files, parts->topic);
  }
  return open_video_file(word);
}

std::string file_of_source(const std::string& word) {
  if (const auto bag = bag_word(word)) return bag->file;
  const auto parts = parts_of_bag(word);
  return parts ? parts->folder : word;
}

}  // namespace swarmsmith
