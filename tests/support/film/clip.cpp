#include "tests/support/film/clip.h"

#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>

#include "tracking/video/video_writer.h"

namespace swarmsmith::film {
namespace {

cv::Mat as_mat(const ColorImage& image) {
  return cv::Mat(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.bgr.data()));
}

void check(const Expected<void>& done) {
  if (!done) throw std::runtime_error(to_string(done.error()));
}

/// Where pictures go, one after the other.
class Sink {
 public:
  Sink(std::filesystem::path file, ClipForm form, ImageSize size, double rate_hz)
      : file_(std::move(file)), form_(form), rate_hz_(rate_hz) {
    if (form == ClipForm::Folder) {
      std::filesystem::remove_all(file_);
      std::filesystem::create_directories(file_);
      return;
    }
    VideoOptions options;
    options.codec = form == ClipForm::Mjpg ? "mjpeg" : "h264";
    options.frame_rate = rate_hz;
    options.quality = 60;  // what cameras do: noise costs most of the bits
    Expected<VideoWriter> opened = VideoWriter::open(file_.string(), size, options);
    if (!opened) throw std::runtime_error(to_string(opened.error()));
    video_ = std::move(*opened);
  }

  void add(const ColorImage& image, double time_s) {
    if (video_) {
      // An .avi knows no other times.
      check(video_->write(image, form_ == ClipForm::Mjpg ? count_++ / rate_hz_ : time_s));
      return;
    }
    char name[32];
    std::snprintf(name, sizeof name, "%06d.png", count_++);
    write_png(image, file_ / name);
  }

  void finish() {
    if (video_) check(video_->finish());
  }

 private:
  std::filesystem::path file_;
  ClipForm form_;
  double rate_hz_;
  std::optional<VideoWriter> video_;
  int count_ = 0;
};

}  // namespace

void write_png(const ColorImage& image, const std::filesystem::path& file) {
  if (!cv::imwrite(file.string(), as_mat(image), {cv::IMWRITE_PNG_COMPRESSION, 1}))
    throw std::runtime_error("cannot write " + file.string());
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

std::filesystem::path sidecar_of(const std::filesystem::path& clip) {
  // A dot in a folder's name begins no ending.
  const std::filesystem::path ending = clip.extension();
  std::filesystem::path file = clip;
  if (ending == ".mkv" || ending == ".mp4" || ending == ".avi") file.replace_extension();
  return file.concat(".times.csv");
}

std::string ending_of(ClipForm form) {
  switch (form) {
    case ClipForm::Folder:
      return "";
    case ClipForm::Mjpg:
      return ".avi";
    case ClipForm::H264:
      return ".mkv";
  }
  return "";
}

void write_clip(const VirtualCamera& camera, const std::vector<ShotFrame>& frames,
                const std::filesystem::path& file, ClipForm form, double rate_hz, bool sidecar) {
  Sink sink(file, form, camera.shooting().view.camera.size, rate_hz);
  ColorImage image;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    // A picture that is shown twice is the same to the bit.
    if (i == 0 || frames[i].picture != frames[i - 1].picture)
      image = camera.picture(frames[i].true_s, frames[i].picture);
    sink.add(image, frames[i].stamp_s);
  }
  sink.finish();
  if (sidecar) write_text(sidecar_of(file), frame_times_csv(frames));
}

}  // namespace swarmsmith::film
