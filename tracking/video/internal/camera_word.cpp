#include "tracking/video/internal/camera_word.h"

#include <charconv>
#include <filesystem>
#include <system_error>

#include "tracking/rig/issue.h"
#include "tracking/video/internal/picture.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kCamera = "camera:";
constexpr std::string_view kOpenCv = "opencv:";

/// Reads a number from the front of a text.
template <class Number>
bool take(std::string_view& text, Number& value) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  return true;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

bool is_camera_word(std::string_view word) {
  return word.starts_with(kCamera) || word.starts_with(kOpenCv) ||
         word.find("://") != std::string_view::npos || word.find(" ! ") != std::string_view::npos;
}

Expected<CameraWord> camera_word(const std::string& word) {
  CameraWord camera;
  camera.name = word;
  std::string_view rest = word;
  if (!rest.starts_with(kCamera)) {
    if (rest.starts_with(kOpenCv)) rest.remove_prefix(kOpenCv.size());
    camera.address = rest;
    std::error_code ignored;
    camera.is_file = std::filesystem::exists(camera.address, ignored);
    return camera;
  }
  rest.remove_prefix(kCamera.size());
  int index = -1;
  bool right = take(rest, index) && index >= 0;
  if (right && !rest.empty()) {
    right = take(rest, ':') && take(rest, camera.size.width) && take(rest, 'x') &&
            take(rest, camera.size.height) && av::is_taken(camera.size.width, camera.size.height);
    if (right && !rest.empty()) {
      right = take(rest, '@') && take(rest, camera.frame_rate) && camera.frame_rate > 0;
    }
  }
  if (!right || !rest.empty()) {
    return Unexpected(
        error_of(IssueCode::Config, "write a camera as camera:0 or camera:0:1920x1080@30", word));
  }
  camera.index = index;
  return camera;
}

}  // namespace swarmsmith
