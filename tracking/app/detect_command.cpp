#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "base/median.h"
#include "base/plain_text.h"
#include "base/text/csv.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "console/counter.h"
#include "sim/mission/trajectory_csv.h"
#include "tracking/app/commands.h"
#include "tracking/app/written_files.h"
#include "tracking/detection/tag_detector.h"
#include "tracking/observing/other_family.h"
#include "tracking/rig/issue.h"

namespace swarmsmith {
namespace {

struct DetectWords {
  std::string source;
  std::string family = "tag36h11";
  std::string csv;
  std::optional<std::int64_t> every;
};

/// The sightings of one tag.
struct SeenTag {
  std::int64_t frames = 0;
  std::int64_t twice = 0;      ///< number of frames with the tag more than once
  std::int64_t corrected = 0;  ///< number of sightings with a wrong bit
  std::vector<double> edges_px;
  std::vector<double> margins;
};

struct Finds {
  std::int64_t frames = 0;
  std::map<int, SeenTag> tags;
  std::string csv = "frame,time_s,file,tag,hamming,margin,edge_px,u,v,u0,v0,u1,v1,u2,v2,u3,v3\n";
  bool is_mirrored = false;
  std::vector<std::string> notes;
};

/// The shortest side, which decides whether a tag is found.
double edge_of(const TagCorners& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ImagePoint& a = corners[i];
    const ImagePoint& b = corners[(i + 1) % corners.size()];
    least = std::min(least, std::hypot(a.u - b.u, a.v - b.v));
  }
  return least;
}

void add_row(std::string& csv, const Frame& frame, const Detection& tag) {
  const ImagePoint middle = middle_of(tag.corners);
  csv += fmt::format("{},", frame.number);
  if (frame.time_s) append_number(csv, *frame.time_s);
  csv += fmt::format(",{},{},{},{:.2f},{:.3f},{:.3f},{:.3f}", csv_field(frame.file), tag.tag,
                     tag.hamming, tag.margin, edge_of(tag.corners), middle.u, middle.v);
  for (const ImagePoint& corner : tag.corners)
    csv += fmt::format(",{:.3f},{:.3f}", corner.u, corner.v);
  csv += kCsvLineEnd;
}

void add(Finds& finds, const Frame& frame, const std::vector<Detection>& seen) {
  ++finds.frames;
  std::map<int, int> counts;
  for (const Detection& tag : seen) {
    SeenTag& all = finds.tags[tag.tag];
    const int count = ++counts[tag.tag];
    if (count == 1) ++all.frames;
    if (count == 2) ++all.twice;
    if (tag.hamming > 0) ++all.corrected;
    all.edges_px.push_back(edge_of(tag.corners));
    all.margins.push_back(tag.margin);
    add_row(finds.csv, frame, tag);
  }
}

Expected<Finds> look(const DetectWords& words, Output& output) {
  auto detector = TagDetector::of_family(words.family);
  if (!detector) return Unexpected(detector.error());
  auto source = FrameSource::open(words.source);
  if (!source) return Unexpected(source.error());
  if ((*source)->info().is_live) {
    return bad_input("a live camera has no end: watch it with `swarmsmith track live`",
                     words.source);
  }
  const std::int64_t every = words.every.value_or(1);
  Finds finds;
  std::optional<std::string> family;  // sentence about another family that was found instead of the
                                      // requested one
  Counter counter(output, "looked at", "pictures");
  for (std::int64_t done = 1;; ++done) {
    const auto more = (*source)->next();
    if (!more) return Unexpected(more.error());
    if (!*more) break;
    counter.tell(done, (*source)->info().expected_frames);
    const Frame& frame = (*source)->frame();
    if (frame.number % every != 0) continue;
    const std::vector<Detection> seen = detector->find(frame.gray, 1);
    if (finds.frames == 0 && seen.empty()) {
      finds.is_mirrored = is_mirrored(*detector, frame.gray);
      family = other_family(words.family, frame.gray);
    }
    add(finds, frame, seen);
  }
  if (finds.frames == 0) {
    return Unexpected(error_of(IssueCode::VideoUnreadable, "no frame could be read", words.source));
  }
  finds.notes = (*source)->info().oddities;
  if (finds.tags.empty() && family) finds.notes.push_back(*family);
  if (const std::int64_t damaged = (*source)->damaged_frames(); damaged > 0)
    finds.notes.push_back(counted(damaged, "of its pictures is damaged and was",
                                  "of its pictures are damaged and were") +
                          " left out");
  if ((*source)->info().is_truncated)
    finds.notes.emplace_back(
        "it is shorter than its header says; copy it again, or check how its "
        "recording ended");
  return finds;
}

void print(const Finds& finds, Output& output) {
  if (output.json) {
    const auto tag_json = [](const auto& found) {
      const auto& [tag, seen] = found;
      return JsonObject()
          .add("tag", tag)
          .add("frames", seen.frames)
          .add("twice", seen.twice)
          .add("corrected", seen.corrected)
          .add("edge_px", upper_median(seen.edges_px))
          .add("margin", upper_median(seen.margins));
    };
    output.out << JsonObject()
                      .add("frames", finds.frames)
                      .add("mirrored", finds.is_mirrored)
                      .add("notes", finds.notes)
                      .add("tags", json_list(finds.tags, tag_json))
                      .text()
               << "\n";
    return;
  }
  output.out << "   tag  frames   of  edge px  margin  bits mended  twice\n";
  for (const auto& [tag, seen] : finds.tags) {
    output.out << fmt::format("{:>6} {:>7} {:>4} {:>8.1f} {:>7.0f} {:>12} {:>6}\n", tag,
                              seen.frames, finds.frames, upper_median(seen.edges_px),
                              upper_median(seen.margins), seen.corrected, seen.twice);
  }
  if (finds.tags.empty()) output.out << "  none\n";
  if (finds.is_mirrored) print_note(output, kMirroredAdvice);
  for (const std::string& note : finds.notes)
    print_note(output, "note: " + note);
  constexpr double kSmall_px = 24;
  std::string small;
  for (const auto& [tag, seen] : finds.tags) {
    if (upper_median(seen.edges_px) < kSmall_px)
      small += (small.empty() ? "" : ", ") + std::to_string(tag);
  }
  if (small.empty()) return;
  print_note(output,
             fmt::format("tags with an edge below {:.0f} px can be missed: {}; use larger tags, "
                         "more pixels or a nearer camera",
                         kSmall_px, small));
}

ExitCode run(const DetectWords& words, Output& output) {
  if (const auto flaw = flaw_of_output(words.csv)) return fail(output, ExitCode::Failed, *flaw);
  const auto finds = look(words, output);
  if (!finds) return fail(output, exit_code_of_tracking(finds.error()), finds.error());
  if (words.csv == "-") {
    output.out << finds->csv;
    return ExitCode::Done;
  }
  if (!words.csv.empty()) {
    if (const auto written = write_whole_file(words.csv, finds->csv); !written)
      return fail(output, ExitCode::Failed, written.error());
  }
  print(*finds, output);
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_detect(Options& options) {
  auto words = std::make_shared<DetectWords>();
  options.text("SOURCE FILE", words->source, "Video, picture, folder of pictures or bag",
               Options::Need::Required);
  options.text("--family FAMILY", words->family, "Family of the tags (default tag36h11)");
  options.integer("--every", words->every, {1, 1'000'000}, "Use each N-th frame (default 1)");
  options.text("--csv FILE", words->csv,
               "Write one row per sighting: frame, time, tag, corners in pixels (- prints)");
  return [words](Output& output) { return run(*words, output); };
}

}  // namespace swarmsmith
