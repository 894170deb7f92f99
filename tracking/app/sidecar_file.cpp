#include "tracking/app/sidecar_file.h"

#include <array>
#include <utility>

#include "base/text/whole_file.h"
#include "tracking/video/frame_clock.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {

namespace fs = std::filesystem;

fs::path sidecar_beside(const std::string& source) {
  fs::path video(file_of_source(source));
  if (video.filename().empty()) video = video.parent_path();
  std::error_code trouble;
  std::array names{fs::path(video).replace_extension(".times.csv"),
                   fs::path(video).concat(".times.csv")};
  // A dot in a folder's name does not begin an extension.
  if (fs::is_directory(video, trouble)) std::swap(names[0], names[1]);
  for (const fs::path& name : names) {
    if (fs::exists(name, trouble)) return name;
  }
  return {};
}

Expected<std::optional<std::vector<double>>> times_beside(const std::string& source) {
  const fs::path sidecar = sidecar_beside(source);
  if (sidecar.empty()) return std::nullopt;
  const auto text = read_file(sidecar, "times");
  if (!text) return Unexpected(text.error());
  auto times = parse_frame_times(*text);
  if (!times) {
    Error error = times.error();
    error.where = sidecar.string() + (error.where.empty() ? "" : ":" + error.where);
    return Unexpected(error);
  }
  return std::optional(std::move(*times));
}

}  // namespace swarmsmith
