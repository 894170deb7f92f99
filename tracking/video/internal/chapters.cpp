#include "tracking/video/internal/chapters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <system_error>
#include <utility>

#include "tracking/rig/issue.h"
#include "tracking/video/internal/image_folder.h"
#include "tracking/video/internal/natural_order.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> kEndings = {".mp4", ".mkv", ".mov",  ".avi", ".webm",
                                                      ".ts",  ".bag", ".mcap", ".db3"};

/// A chapter whose first time is below this has a clock that starts anew.
constexpr double kNear_s = 1;

class Chapters final : public FrameSource {
 public:
  Chapters(std::string name, std::vector<std::string> words, std::unique_ptr<FrameSource> first)
      : words_(std::move(words)), source_(std::move(first)) {
    info_ = source_->info();
    info_.name = std::move(name);
    if (words_.size() > 1) info_.expected_frames = 0;
    if (!info_.has_times) info_.has_count = info_.has_count && info_.frame_rate > 0;
  }

  const SourceInfo& info() const override { return info_; }
  const Frame& frame() const override { return frame_; }
  ColorImage color() override { return source_->color(); }
  std::int64_t damaged_frames() const override { return damaged_ + source_->damaged_frames(); }

  Expected<bool> next() override {
    while (true) {
      const auto more = source_->next();
      if (!more) return Unexpected(more.error());
      if (*more) return take();
      if (at_ + 1 == words_.size()) return false;
      if (auto opened = go_on(); !opened) return Unexpected(opened.error());
    }
  }

 private:
  Expected<bool> take() {
    const Frame& part = source_->frame();
    frame_ = part;
    frame_.number = first_number_ + part.number;
    ++shown_;
    if (!part.time_s) return true;
    if (is_first_) {
      is_first_ = false;
      // The last interval is the best estimate of the interval between two chapters.
      offset_s_ = last_s_ && *part.time_s < kNear_s ? *last_s_ + interval_s_ - *part.time_s : 0;
    }
    const double time = *part.time_s + offset_s_;
    if (last_s_ && time > *last_s_) interval_s_ = time - *last_s_;
    last_s_ = time;
    frame_.time_s = time;
    return true;
  }

  Expected<void> go_on() {
    // Damaged frames also have numbers.
    first_number_ += shown_ + source_->damaged_frames();
    damaged_ += source_->damaged_frames();
    shown_ = 0;
    auto opened = FrameSource::open(words_[++at_]);
    if (!opened) return Unexpected(opened.error());
    const SourceInfo& info = (*opened)->info();
    if (info.size != info_.size || info.has_times != info_.has_times) {
      return Unexpected(error_of(
          IssueCode::VideoUnreadable,
          fmt::format("is {} x {} pixels{}, but the chapter before {} x {}{}; a folder of chapters "
                      "must contain the film of one camera",
                      info.size.width, info.size.height, info.has_times ? "" : " without times",
                      info_.size.width, info_.size.height, info_.has_times ? "" : " without times"),
          words_[at_]));
    }
    source_ = std::move(*opened);
    is_first_ = true;
    return {};
  }

  SourceInfo info_;
  std::vector<std::string> words_;
  std::size_t at_ = 0;
  std::unique_ptr<FrameSource> source_;
  Frame frame_{.number = -1, .time_s = {}, .gray = {}, .file = {}};
  std::int64_t first_number_ = 0;  ///< of the current chapter
  std::int64_t damaged_ = 0;       ///< in the previous chapters
  std::int64_t shown_ = 0;         ///< in the current chapter
  bool is_first_ = true;
  std::optional<double> last_s_;
  double interval_s_ = 0;
  double offset_s_ = 0;
};

}  // namespace

std::optional<std::vector<std::string>> chapters_in(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (!entry->is_regular_file(ignored) || entry->path().filename().string().starts_with('.'))
      continue;
    if (is_image_file(entry->path().string())) return std::nullopt;
    std::string ending = entry->path().extension().string();
    for (char& c : ending)
      c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (std::ranges::find(kEndings, ending) != kEndings.end())
      files.push_back(entry->path().string());
  }
  if (error || files.empty()) return std::nullopt;
  std::ranges::sort(files, comes_before);
  return files;
}

Expected<std::unique_ptr<FrameSource>> open_chapters(const std::string& word,
                                                     const std::vector<std::string>& files,
                                                     const std::string& topic) {
  std::vector<std::string> words;
  words.reserve(files.size());
  for (const std::string& file : files)
    words.push_back(topic.empty() ? file : file + ":" + topic);
  auto first = FrameSource::open(words.front());
  if (!first) return Unexpected(first.error());
  return std::make_unique<Chapters>(word, std::move(words), std::move(*first));
}

}  // namespace swarmsmith
