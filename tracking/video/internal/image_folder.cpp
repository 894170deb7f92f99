#include "tracking/video/internal/image_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "tracking/video/internal/byte_stream.h"
#include "tracking/video/internal/iso_time.h"
#include "tracking/video/internal/natural_order.h"
#include "tracking/video/internal/picture.h"
#include "tracking/video/internal/still_picture.h"
#include "tracking/video/internal/unreadable.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> kEndings = {".png", ".jpg",  ".jpeg", ".bmp",
                                                      ".tif", ".tiff", ".pgm",  ".ppm"};

bool is_image_name(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return !path.filename().string().starts_with('.') &&
         std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

/// Reads a whole file into a packet.
Expected<av::PacketPtr> packet_of(const std::string& path) {
  constexpr std::int64_t kMostBytes = std::int64_t{400} << 20;
  auto bytes = av::ByteStream::reading(path);
  if (!bytes) return Unexpected(bytes.error());
  if (bytes->size() == 0) return unreadable("the file is empty", path);
  if (bytes->size() > kMostBytes) return unreadable("is larger than 400 MB", path);
  av::PacketPtr packet(av_packet_alloc());
  const int size = static_cast<int>(bytes->size());
  if (av_new_packet(packet.get(), size) < 0) return unreadable("no memory for it", path);
  if (avio_read(bytes->io(), packet->data, size) != size) {
    return unreadable("cannot be read to its end", path);
  }
  return packet;
}

Expected<av::FramePtr> picture_of(const std::string& path) {
  auto packet = packet_of(path);
  if (!packet) return Unexpected(packet.error());
  return av::decode_still(**packet, path);
}

class ImageFolder final : public FrameSource {
 public:
  ImageFolder(SourceInfo info, std::vector<std::string> files)
      : info_(std::move(info)), files_(std::move(files)) {}

  const SourceInfo& info() const override { return info_; }
  const Frame& frame() const override { return frame_; }
  ColorImage color() override { return pictures_.color(*picture_); }
  std::int64_t damaged_frames() const override { return damaged_; }

  Expected<bool> next() override {
    while (next_ < files_.size()) {
      const std::string& file = files_[next_];
      const auto number = static_cast<std::int64_t>(next_++);
      auto picture = picture_of(file);
      if (!picture) {
        ++damaged_;
        continue;
      }
      picture_ = std::move(*picture);
      if (picture_->width != info_.size.width || picture_->height != info_.size.height) {
        return unreadable(
            fmt::format("is {} x {} pixels, but the images before it {} x {}; a folder "
                        "must contain pictures of one camera, all of one size",
                        picture_->width, picture_->height, info_.size.width, info_.size.height),
            file);
      }
      const auto gray = pictures_.gray(*picture_);
      if (!gray) return unreadable("its pixel format cannot be read", file);
      frame_ = {.number = number,
                .time_s = info_.has_times ? time_in_name(file) : std::nullopt,
                .gray = *gray,
                .file = file};
      return true;
    }
    return false;
  }

 private:
  SourceInfo info_;
  std::vector<std::string> files_;
  std::size_t next_ = 0;
  av::FramePtr picture_;
  av::Pictures pictures_;
  Frame frame_;
  std::int64_t damaged_ = 0;
};

Expected<std::unique_ptr<FrameSource>> open_files(const std::string& path,
                                                  std::vector<std::string> files) {
  SourceInfo info;
  info.name = path;
  info.expected_frames = static_cast<std::int64_t>(files.size());
  // If all names have the same date, it is not the time of a picture.
  std::vector<std::optional<double>> times;
  for (const std::string& file : files)
    times.push_back(time_in_name(file));
  info.has_times = std::ranges::all_of(times, [](const auto& time) { return time.has_value(); }) &&
                   std::ranges::adjacent_find(times) == times.end();
  // The first readable picture gives the size.
  std::optional<Error> first_error;
  for (const std::string& file : files) {
    const auto picture = picture_of(file);
    if (picture) {
      info.size = {(*picture)->width, (*picture)->height};
      return std::make_unique<ImageFolder>(std::move(info), std::move(files));
    }
    if (!first_error) first_error = picture.error();
  }
  return Unexpected(*first_error);
}

}  // namespace

std::optional<double> time_in_name(const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  if (const auto time = iso_time_in(stem)) return time;
  constexpr const char* kDigits = "0123456789";
  for (std::size_t begin = stem.find_first_of(kDigits); begin != std::string::npos;) {
    const std::size_t end = std::min(stem.find_first_not_of(kDigits, begin), stem.size());
    const std::string number = stem.substr(begin, end - begin);
    begin = stem.find_first_of(kDigits, end);
    // Times since 2001 do not begin with 0; counters may.
    if (number.front() == '0') continue;
    if (number.size() == 13) return std::stod(number) * 1e-3;
    if (number.size() == 16) return std::stod(number) * 1e-6;
    if (number.size() == 19) return std::stod(number) * 1e-9;
    if (number.size() != 10) continue;
    const bool has_more = begin == end + 1;
    const std::size_t rest = std::min(stem.find_first_not_of(kDigits, end + 1), stem.size());
    const bool is_part = has_more && (stem[end] == '.' || rest - begin == 9);
    return std::stod(number) + (is_part ? std::stod("0." + stem.substr(begin, rest - begin)) : 0);
  }
  return std::nullopt;
}

bool is_image_file(const std::string& path) {
  std::error_code ignored;
  return is_image_name(path) && fs::is_regular_file(path, ignored);
}

Expected<std::unique_ptr<FrameSource>> open_image(const std::string& path) {
  av::set_up();
  return open_files(path, {path});
}

Expected<std::unique_ptr<FrameSource>> open_image_folder(const std::string& path) {
  av::set_up();
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored) && is_image_name(entry->path())) {
      files.push_back(entry->path().string());
    }
  }
  if (error) return unreadable("cannot be listed: " + error.message(), path);
  if (files.empty()) {
    return unreadable("the folder has no image (.png, .jpg, .bmp, .tif, .pgm, .ppm)", path);
  }
  std::sort(files.begin(), files.end(), comes_before);
  return open_files(path, std::move(files));
}

}  // namespace swarmsmith
