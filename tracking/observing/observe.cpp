#include "tracking/observing/observe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <set>
#include <utility>

#include "base/plain_text.h"
#include "tracking/geometry/tag_family.h"
#include "tracking/observing/other_family.h"
#include "tracking/observing/reference_medians.h"

namespace swarmsmith {
namespace {

/// A container's count of frames may be slightly wrong although no frame was lost.
constexpr double kCountsMayDiffer = 0.01;

/// Keeps the previous picture to detect repeats, which camera programs write instead of lost
/// frames.
class LastPicture {
 public:
  /// Whether the picture is equal to the last one, bit for bit; stores it as the last one.
  bool is_repeated_by(const GrayImage& image) {
    width_ = image.width;
    height_ = image.height;
    const auto width = static_cast<std::size_t>(image.width);
    const auto height = static_cast<std::size_t>(image.height);
    bool same = pixels_.size() == width * height;
    pixels_.resize(width * height);
    for (std::size_t row = 0; row < height; ++row) {
      const std::uint8_t* const now =
          image.pixels + static_cast<std::ptrdiff_t>(row) * image.stride;
      std::uint8_t* const before = &pixels_[row * width];
      if (same && std::memcmp(before, now, width) == 0) continue;
      same = false;
      std::memcpy(before, now, width);
    }
    return same;
  }
  GrayImage image() const { return {pixels_.data(), width_, height_, width_}; }

 private:
  std::vector<std::uint8_t> pixels_;
  int width_ = 0;
  int height_ = 0;
};

/// Collects sightings and medians of one camera, frame by frame.
class Recorder {
 public:
  Recorder(const CameraSetup& camera, const ObserveOptions& options, int rows)
      : camera_(camera),
        references_(options.references),
        rows_(rows),
        medians_(options.reference_span_s) {}

  void add(std::int64_t frame, double time_s, const std::vector<Detection>& seen) {
    for (const Detection& each : seen) {
      if (references_.contains(each.tag)) {
        if (is_there_once(each.tag, seen)) medians_.add(time_s, each.tag, each.corners);
        continue;
      }
      const double v = middle_of(each.corners).v;
      sightings_.push_back({0, frame, exposed_at(camera_, time_s, v, rows_), each.tag, each.corners,
                            each.hamming, each.margin});
    }
  }

  std::vector<Sighting> take_sightings() { return std::move(sightings_); }
  std::vector<ReferenceLook> take_references() { return medians_.take(); }

 private:
  static bool is_there_once(int tag, const std::vector<Detection>& seen) {
    return std::count_if(seen.begin(), seen.end(),
                         [&](const Detection& other) { return other.tag == tag; }) == 1;
  }

  const CameraSetup& camera_;
  const std::set<int>& references_;
  int rows_;
  ReferenceMedians medians_;
  std::vector<Sighting> sightings_;
};

Issue truncated(const std::string& name, const std::string& what) {
  return {IssueCode::VideoTruncated, name + ": " + what, {}, std::nullopt, std::nullopt};
}

/// Evaluates how a video ended: adds an issue, or returns an error if it was not a video at all.
Expected<void> note_end(const ObservedVideo& video, const std::optional<Error>& broken,
                        CameraObservations& seen) {
  const SourceInfo& info = video.source.info();
  const std::int64_t frames = seen.record.frames;
  if (frames == 0)
    return broken.has_value()
               ? Expected<void>(Unexpected(*broken))
               : Expected<void>(Unexpected(error_of(IssueCode::VideoUnreadable,
                                                    "no frame could be read; is it a video, and "
                                                    "was its recording ended properly?",
                                                    info.name)));
  if (broken.has_value()) {
    seen.issues.push_back(truncated(
        info.name,
        fmt::format("it broke off after {}, at {:.3f} s of its clock: {}", counted(frames, "frame"),
                    seen.record.frame_times.back(), to_string(*broken))));
    return {};
  }
  const auto wanted = static_cast<double>(info.expected_frames);
  const auto got = static_cast<double>(frames + seen.record.damaged_frames);
  if (info.is_truncated || wanted - got > std::max(2.0, kCountsMayDiffer * wanted))
    seen.issues.push_back(truncated(
        info.name,
        fmt::format("it ends before its own header says, after {}, at {:.3f} s of its clock; "
                    "copy it again, or check how its recording ended",
                    counted(frames, "frame"), seen.record.frame_times.back())));
  return video.clock.finish(frames + seen.record.damaged_frames);
}

std::string listed(const std::vector<int>& tags) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(tags.size(), kMost); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", tags[i]);
  return text + (tags.size() > kMost ? ", ..." : "");
}

}  // namespace

std::optional<std::string> other_family(const std::string& own, const GrayImage& image) {
  constexpr double kSureMargin = 40;
  for (const TagFamily& family : known_tag_families()) {
    if (family.name == own) continue;
    auto detector = TagDetector::of_family(std::string(family.name));
    if (!detector.has_value()) continue;
    std::vector<int> tags;
    for (const Detection& tag : detector->find(image, 1)) {
      if (tag.hamming == 0 && tag.margin > kSureMargin) tags.push_back(tag.tag);
    }
    if (!tags.empty()) {
      return fmt::format(
          "tags of the family {} are seen ({}), and the arena file says {}; name the family that "
          "was printed",
          family.name, listed(tags), own);
    }
  }
  return std::nullopt;
}

namespace {

/// While no tag has been found, other explanations are tried in these frames.
bool is_to_doubt(std::int64_t frame) {
  return frame == 0 || frame == 20 || frame == 200 || frame == 1000;
}

/// Finds the reason why no tag was found so far.
Expected<void> doubt(const ObserveOptions& options, TagDetector& detector, const GrayImage& image,
                     const std::string& name) {
  if (is_mirrored(detector, image))
    return Unexpected(error_of(IssueCode::VideoUnreadable, kMirroredAdvice, name));
  if (const auto other = other_family(options.family, image))
    return Unexpected(error_of(IssueCode::Config, *other, name));
  return {};
}

/// Adds notes about the film, and about tags that were never seen, using its last picture.
void note_oddities(const SourceInfo& info, const ObserveOptions& options, const std::set<int>& ever,
                   TagDetector& detector, const GrayImage& image, std::vector<Issue>& issues) {
  const auto add = [&](const std::string& text) {
    issues.push_back({IssueCode::FilmOdd, info.name + ": " + text, {}, {}, {}});
  };
  for (const std::string& text : info.oddities)
    add(text);
  std::vector<int> missing;
  std::ranges::set_difference(options.search.expected, ever, std::back_inserter(missing));
  if (missing.empty() || image.pixels == nullptr) return;
  std::vector<int> mirrored;
  for (const int tag : mirrored_tags(detector, image)) {
    if (std::ranges::find(missing, tag) != missing.end()) mirrored.push_back(tag);
  }
  if (!mirrored.empty()) {
    add(
        fmt::format("what is seen of tag {} is its mirror image: it was printed mirrored; print it "
                    "again",
                    listed(mirrored)));
  }
  if (const auto other = other_family(options.family, image)) add(*other);
}

}  // namespace

double exposed_at(const CameraSetup& camera, double stamp_s, double v, int rows) {
  double middle_s = stamp_s;
  if (camera.stamped_at == StampedAt::Start) middle_s += camera.exposure_s / 2;
  if (camera.stamped_at == StampedAt::End) middle_s -= camera.exposure_s / 2;
  return middle_s + v / rows * camera.readout_s;
}

Expected<CameraObservations> observe(ObservedVideo video, const ObserveOptions& options,
                                     const OnFrame& on_frame) {
  auto detector = TagDetector::of_family(options.family);
  if (!detector.has_value()) return Unexpected(detector.error());
  TagSearchOptions search_options = options.search;
  search_options.expected.insert(options.references.begin(), options.references.end());
  search_options.still.insert(options.references.begin(), options.references.end());
  TagSearch search(std::move(*detector), search_options);
  // A separate detector for pictures without a tag, so that `search` is not disturbed.
  auto second = TagDetector::of_family(options.family);
  if (!second.has_value()) return Unexpected(second.error());

  const SourceInfo info = video.source.info();
  CameraObservations result;
  CameraRecord& record = result.record;
  record.camera = video.camera.name;
  record.file = info.name;
  record.sha256 = video.sha256;
  record.size = info.size;
  record.time_source = video.clock.source();
  Recorder recorder(video.camera, options, info.size.height);
  LastPicture last;
  std::vector<Detection> seen;
  std::set<int> ever;
  std::optional<Error> broken;
  while (true) {
    const auto more = video.source.next();
    if (!more.has_value()) broken = more.error();
    if (!more.has_value() || !*more) break;
    const Frame& frame = video.source.frame();
    const auto time_s = video.clock.time_of(frame);
    if (!time_s.has_value()) return Unexpected(time_s.error());
    if (!last.is_repeated_by(frame.gray)) seen = search.find(frame.gray, *time_s);
    for (const Detection& tag : seen)
      ever.insert(tag.tag);
    if (ever.empty() && is_to_doubt(record.frames)) {
      if (auto why = doubt(options, *second, frame.gray, info.name); !why)
        return Unexpected(why.error());
    }
    recorder.add(record.frames, *time_s, seen);
    record.frame_times.push_back(*time_s);
    ++record.frames;
    if (on_frame) on_frame(record.frames, info.expected_frames, seen);
  }
  record.damaged_frames = video.source.damaged_frames();
  record.references = recorder.take_references();
  result.sightings = recorder.take_sightings();
  if (const auto ended = note_end(video, broken, result); !ended.has_value())
    return Unexpected(ended.error());
  note_oddities(info, options, ever, *second, last.image(), result.issues);
  return result;
}

}  // namespace swarmsmith
