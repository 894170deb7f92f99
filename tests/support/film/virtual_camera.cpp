#include "tests/support/film/virtual_camera.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "base/rng.h"
#include "tests/support/film/board_paint.h"
#include "tests/support/film/paint.h"

namespace swarmsmith::film {
namespace {

/// Length of the noise that pictures take their rows from.
constexpr std::size_t kNoiseLength = 1U << 20U;

float light_at(const Shooting& shooting, int u) {
  const double share = u / (shooting.view.camera.size.width - 1.0) - 0.5;
  return static_cast<float>(shooting.gain * (1 + shooting.gradient * share));
}

cv::Vec3b stored(const Bgr& color, float light) {
  return {cv::saturate_cast<std::uint8_t>(color[0] * light),
          cv::saturate_cast<std::uint8_t>(color[1] * light),
          cv::saturate_cast<std::uint8_t>(color[2] * light)};
}

Bgr mean_of(const std::array<Bgr, kSamples>& colors) {
  Bgr sum{};
  for (const Bgr& color : colors) {
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += color[i];
  }
  for (float& part : sum)
    part /= kSamples;
  return sum;
}

Placing placing_of(const Pose& pose) {
  return {static_cast<float>(std::cos(pose.theta)), static_cast<float>(std::sin(pose.theta)),
          static_cast<float>(pose.x), static_cast<float>(pose.y)};
}

/// Box around points of the image, with room.
cv::Rect box_around(const std::vector<ImagePoint>& points, double room) {
  double left = 1e9;
  double top = 1e9;
  double right = -1e9;
  double bottom = -1e9;
  for (const ImagePoint& p : points) {
    left = std::min(left, p.u);
    right = std::max(right, p.u);
    top = std::min(top, p.v);
    bottom = std::max(bottom, p.v);
  }
  const auto whole = [](double value) { return static_cast<int>(std::clamp(value, -1e6, 1e6)); };
  const int x = whole(std::floor(left - room));
  const int y = whole(std::floor(top - room));
  return {x, y, whole(std::ceil(right + room)) - x + 1, whole(std::ceil(bottom + room)) - y + 1};
}

/// Boxes that touch become one.
std::vector<cv::Rect> merged(std::vector<cv::Rect> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      if (k == i || (boxes[i] & boxes[k]).empty()) continue;
      boxes[i] |= boxes[k];
      boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(k));
      return merged(std::move(boxes));
    }
  }
  return boxes;
}

}  // namespace

struct VirtualCamera::Stage {
  /// What is seen from one place: the floor and the picture of all that never moves.
  struct Backdrop {
    View view;
    FloorMap floor;
    cv::Mat sharp;
    cv::Mat blurred;
  };

  Scene scene;
  Shooting shooting;
  std::shared_ptr<const LensMap> lens;
  std::map<int, CellPicture> pictures;  ///< by tag
  CellPicture paper;                    ///< that lies on a tag
  std::vector<std::int8_t> noise;
  Rng noise_rows{0};
  std::vector<Backdrop> backdrops;  ///< before and after a bump

  Stage(Scene what, Shooting how, std::shared_ptr<const LensMap> map, std::uint64_t seed)
      : scene(std::move(what)),
        shooting(std::move(how)),
        lens(std::move(map)),
        noise_rows(Rng(seed).split("noise rows")) {
    const auto know = [&](int tag) {
      if (!pictures.contains(tag)) pictures.emplace(tag, tag_picture(scene.family, tag));
    };
    for (const FilmedTag& tag : scene.tags)
      know(tag.tag);
    for (const FilmedRobot& robot : scene.robots) {
      know(robot.tag);
      if (robot.swap_s != kForever_s) know(robot.other_tag);
      if (robot.covered_from_s != kForever_s) {
        paper = tag_picture(scene.family, robot.tag);
        std::ranges::fill(paper.gray, std::uint8_t{255});
      }
    }
    fill_noise(Rng(seed).split("noise"));
    backdrops.push_back(backdrop_from(shooting.view.place));
    if (shooting.bump_s != kForever_s) backdrops.push_back(backdrop_from(shooting.bumped));
  }

  void fill_noise(Rng rng) {
    if (shooting.noise <= 0) return;
    noise.resize(kNoiseLength + static_cast<std::size_t>(lens->size.width));
    for (std::int8_t& value : noise)
      value = cv::saturate_cast<std::int8_t>(std::floor(rng.normal(0.5, shooting.noise)));
  }

  int margin() const { return static_cast<int>(std::ceil(3 * shooting.blur_px)) + 1; }
  cv::Rect frame() const { return {0, 0, lens->size.width, lens->size.height}; }

  void blur(const cv::Mat& from, cv::Mat& to) const {
    if (shooting.blur_px <= 0) {
      from.copyTo(to);
    } else {
      const int side = 2 * (margin() - 1) + 1;
      cv::GaussianBlur(from, to, {side, side}, shooting.blur_px, shooting.blur_px,
                       cv::BORDER_REPLICATE);
    }
  }

  Backdrop backdrop_from(const CameraPlace& place) const;
  Painted painted(const FilmedTag& tag) const;
  Painted painted(const FilmedRobot& robot, double time_s) const;
  void place_robot(Painted& thing, const FilmedRobot& robot, double row_time_s) const;
  std::vector<ImagePoint> outline_of(const Backdrop& from, const FilmedRobot& robot,
                                     double time_s) const;
  std::vector<ImagePoint> outline_of(const Backdrop& from, const FilmedTag& tag) const;
  std::vector<ImagePoint> outline_of(const Backdrop& from, const Arm& arm) const;
  std::vector<cv::Rect> moving_boxes(const Backdrop& from, double time_s) const;
  void paint_window(const Backdrop& from, const cv::Rect& box, double time_s, cv::Mat& sharp) const;
  void add_noise(cv::Mat& image, std::int64_t number) const;
  double row_time(double time_s, double v) const {
    return time_s + v / lens->size.height * shooting.readout_s;
  }
};

VirtualCamera::Stage::Backdrop VirtualCamera::Stage::backdrop_from(const CameraPlace& place) const {
  Backdrop made{{shooting.view.camera, place}, FloorMap(*lens, place), {}, {}};
  const FloorMap& floor = made.floor;
  const std::vector<Point> corners = corners_of(scene.arena);
  made.sharp.create(lens->size.height, lens->size.width, CV_8UC3);
  for (int v = 0; v < lens->size.height; ++v) {
    for (int u = 0; u < lens->size.width; ++u) {
      const Footprint f = floor.at(u, v);
      const auto seen = [&](float du, float dv) {
        return arena_color(scene.arena, corners, floor.camera(),
                           {f.x + du * f.x_u + dv * f.x_v, f.y + du * f.y_u + dv * f.y_v});
      };
      // Most pixels are of one colour.
      const Bgr corner = seen(-0.5F, -0.5F);
      Bgr color = corner;
      if (seen(0.5F, -0.5F) != corner || seen(-0.5F, 0.5F) != corner ||
          seen(0.5F, 0.5F) != corner) {
        std::array<Bgr, kSamples> colors;
        for (int i = 0; i < kSamples; ++i) {
          colors[static_cast<std::size_t>(i)] =
              seen((static_cast<float>(i % kFine) + 0.5F) / kFine - 0.5F,
                   (static_cast<float>(i / kFine) + 0.5F) / kFine - 0.5F);
        }
        color = mean_of(colors);
      }
      made.sharp.at<cv::Vec3b>(v, u) = stored(color, light_at(shooting, u));
    }
  }
  for (const FilmedTag& tag : scene.tags) {
    if (!tag.always()) continue;
    const Painted thing = painted(tag);
    const cv::Rect box = box_around(outline_of(made, tag), 2) & frame();
    for (int v = box.y; v < box.y + box.height; ++v) {
      for (int u = box.x; u < box.x + box.width; ++u) {
        const float light = light_at(shooting, u);
        const cv::Vec3b below = made.sharp.at<cv::Vec3b>(v, u);
        std::array<Bgr, kSamples> colors;
        colors.fill({static_cast<float>(below[0]) / light, static_cast<float>(below[1]) / light,
                     static_cast<float>(below[2]) / light});
        paint(thing, floor.at(u, v), floor.camera(), colors);
        made.sharp.at<cv::Vec3b>(v, u) = stored(mean_of(colors), light);
      }
    }
  }
  for (const FilmedBoard& board : scene.boards)
    paint_board(
        board, *lens, [&](int u) { return light_at(shooting, u); }, made.sharp);
  blur(made.sharp, made.blurred);
  return made;
}

Painted VirtualCamera::Stage::painted(const FilmedTag& tag) const {
  const CellPicture& picture = pictures.at(tag.tag);
  const auto cell = static_cast<float>(tag.edge_m / (picture.width - 2 * picture.border));
  return {{&picture, static_cast<float>(tag.height_m), cell,
           cell * static_cast<float>(picture.width) / 2},
          {},
          {placing_of(tag.pose)},
          {}};
}

Painted VirtualCamera::Stage::painted(const FilmedRobot& robot, double time_s) const {
  const bool is_covered = robot.covered_from_s <= time_s && time_s < robot.covered_until_s;
  const CellPicture& picture =
      is_covered ? paper : pictures.at(time_s < robot.swap_s ? robot.tag : robot.other_tag);
  const auto cell = static_cast<float>(robot.edge_m / (picture.width - 2 * picture.border));
  constexpr float kRim_m = 0.004F;
  return {{&picture, static_cast<float>(robot.height_m), cell,
           cell * static_cast<float>(picture.width) / 2 + kRim_m},
          {static_cast<float>(robot.side_m / 2), static_cast<float>(robot.body_height_m)},
          {},
          {}};
}

void VirtualCamera::Stage::place_robot(Painted& thing, const FilmedRobot& robot,
                                       double row_time_s) const {
  const int moments = shooting.exposure_s > 0 ? kSamples : 1;
  thing.tags.clear();
  thing.robots.clear();
  for (int i = 0; i < moments; ++i) {
    const double shift = moments == 1 ? 0 : moment_of(i) * shooting.exposure_s;
    const Pose pose = robot.path.at(row_time_s + shift);
    thing.robots.push_back(placing_of(pose));
    thing.tags.push_back(placing_of(tag_pose_of_robot(pose, robot.offset)));
  }
}

std::vector<ImagePoint> VirtualCamera::Stage::outline_of(const Backdrop& from,
                                                         const FilmedRobot& robot,
                                                         double time_s) const {
  std::vector<ImagePoint> points;
  const double half_exposure = shooting.exposure_s / 2;
  for (const double t : {time_s - half_exposure, time_s + half_exposure + shooting.readout_s}) {
    const Pose pose = robot.path.at(t);
    const Pose tag = tag_pose_of_robot(pose, robot.offset);
    const double plate = robot.edge_m * 0.75;
    for (const ImagePoint& p : corners_of_tag(from.view, tag, 2 * plate, robot.height_m))
      points.push_back(p);
    for (const double z : {0.0, robot.body_height_m}) {
      for (const ImagePoint& p : corners_of_tag(from.view, pose, robot.side_m, z))
        points.push_back(p);
    }
  }
  return points;
}

std::vector<ImagePoint> VirtualCamera::Stage::outline_of(const Backdrop& from,
                                                         const FilmedTag& tag) const {
  const TagCorners corners = corners_of_tag(from.view, tag.pose, tag.edge_m * 1.6, tag.height_m);
  return {corners.begin(), corners.end()};
}

std::vector<ImagePoint> VirtualCamera::Stage::outline_of(const Backdrop& from,
                                                         const Arm& arm) const {
  std::vector<ImagePoint> points;
  for (const Point& end : {arm.from, arm.to}) {
    for (const ImagePoint& p :
         corners_of_tag(from.view, {end.x, end.y, 0}, 2 * arm.radius_m, arm.height_m))
      points.push_back(p);
  }
  return points;
}

std::vector<cv::Rect> VirtualCamera::Stage::moving_boxes(const Backdrop& from,
                                                         double time_s) const {
  // Room for the blur and for what a pose does between the two ends of a frame's time.
  const double room = margin() + 2;
  std::vector<cv::Rect> boxes;
  const auto add = [&](const std::vector<ImagePoint>& outline) {
    const cv::Rect box = box_around(outline, room) & frame();
    if (!box.empty()) boxes.push_back(box);
  };
  for (const FilmedRobot& robot : scene.robots)
    add(outline_of(from, robot, time_s));
  for (const FilmedTag& tag : scene.tags) {
    if (!tag.always() && tag.from_s <= time_s && time_s < tag.until_s) add(outline_of(from, tag));
  }
  for (const Arm& arm : scene.arms) {
    if (arm.from_s <= time_s && time_s < arm.until_s) add(outline_of(from, arm));
  }
  return merged(std::move(boxes));
}

void VirtualCamera::Stage::paint_window(const Backdrop& from, const cv::Rect& box, double time_s,
                                        cv::Mat& sharp) const {
  std::vector<std::pair<Painted, const FilmedRobot*>> things;
  for (const FilmedTag& tag : scene.tags) {
    if (!tag.always() && tag.from_s <= time_s && time_s < tag.until_s)
      things.emplace_back(painted(tag), nullptr);
  }
  for (const FilmedRobot& robot : scene.robots) {
    if (!(box_around(outline_of(from, robot, time_s), margin() + 2) & box).empty())
      things.emplace_back(painted(robot, time_s), &robot);
  }
  // Higher plates hide lower ones.
  std::stable_sort(things.begin(), things.end(), [](const auto& a, const auto& b) {
    return a.first.plate.height_m < b.first.plate.height_m;
  });
  for (int v = box.y; v < box.y + box.height; ++v) {
    if (v == box.y || shooting.readout_s > 0) {
      for (auto& [thing, robot] : things) {
        if (robot != nullptr) place_robot(thing, *robot, row_time(time_s, v));
      }
    }
    for (int u = box.x; u < box.x + box.width; ++u) {
      const float light = light_at(shooting, u);
      cv::Vec3b& pixel = sharp.at<cv::Vec3b>(v - box.y, u - box.x);
      const Footprint foot = from.floor.at(u, v);
      std::array<Bgr, kSamples> colors;
      colors.fill({static_cast<float>(pixel[0]) / light, static_cast<float>(pixel[1]) / light,
                   static_cast<float>(pixel[2]) / light});
      for (const auto& [thing, robot] : things)
        paint(thing, foot, from.floor.camera(), colors);
      for (const Arm& arm : scene.arms) {
        if (arm.from_s <= time_s && time_s < arm.until_s)
          paint(arm, foot, from.floor.camera(), colors);
      }
      pixel = stored(mean_of(colors), light);
    }
  }
}

void VirtualCamera::Stage::add_noise(cv::Mat& image, std::int64_t number) const {
  if (noise.empty()) return;
  Rng rows = noise_rows.split("frame", static_cast<std::uint64_t>(number));
  const auto width = static_cast<std::size_t>(image.cols);
  for (int v = 0; v < image.rows; ++v) {
    const std::int8_t* from = noise.data() + rows.next() % kNoiseLength;
    std::uint8_t* to = image.ptr<std::uint8_t>(v);
    // The same for the three colours: it is brightness that tags are read from.
    for (std::size_t u = 0; u < width; ++u) {
      for (std::size_t c = 0; c < 3; ++c) {
        const int sum = to[3 * u + c] + from[u];
        to[3 * u + c] = static_cast<std::uint8_t>(std::clamp(sum, 0, 255));
      }
    }
  }
}

VirtualCamera::VirtualCamera(Scene scene, Shooting shooting, std::shared_ptr<const LensMap> lens,
                             std::uint64_t seed)
    : stage_(
          std::make_unique<Stage>(std::move(scene), std::move(shooting), std::move(lens), seed)) {}

VirtualCamera::VirtualCamera(Scene scene, Shooting shooting, std::uint64_t seed)
    : VirtualCamera(std::move(scene), shooting,
                    std::make_shared<const LensMap>(lens_map_of(shooting.view.camera)), seed) {}

VirtualCamera::VirtualCamera(VirtualCamera&&) noexcept = default;
VirtualCamera& VirtualCamera::operator=(VirtualCamera&&) noexcept = default;
VirtualCamera::~VirtualCamera() = default;

const Scene& VirtualCamera::scene() const {
  return stage_->scene;
}
const Shooting& VirtualCamera::shooting() const {
  return stage_->shooting;
}

ColorImage VirtualCamera::picture(double time_s, std::int64_t number) const {
  const Stage& stage = *stage_;
  const Stage::Backdrop& from =
      stage.backdrops[time_s < stage.shooting.bump_s ? 0 : stage.backdrops.size() - 1];
  cv::Mat image = from.blurred.clone();
  const int margin = stage.margin();
  for (const cv::Rect& box : stage.moving_boxes(from, time_s)) {
    const cv::Rect wide =
        cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
        stage.frame();
    cv::Mat sharp = from.sharp(wide).clone();
    stage.paint_window(from, wide, time_s, sharp);
    cv::Mat soft;
    stage.blur(sharp, soft);
    soft(box - wide.tl()).copyTo(image(box));
  }
  stage.add_noise(image, number);
  const auto* bytes = image.ptr<std::uint8_t>();
  return {image.cols, image.rows, {bytes, bytes + image.total() * image.elemSize()}};
}

TagCorners VirtualCamera::corners_of_robot(std::size_t robot, double time_s) const {
  const Stage& stage = *stage_;
  const FilmedRobot& filmed = stage.scene.robots.at(robot);
  const View& view =
      stage.backdrops[time_s < stage.shooting.bump_s ? 0 : stage.backdrops.size() - 1].view;
  const auto seen_at = [&](double t) {
    return corners_of_tag(view, tag_pose_of_robot(filmed.path.at(t), filmed.offset), filmed.edge_m,
                          filmed.height_m);
  };
  TagCorners corners = seen_at(time_s);
  // A corner is seen when the row that it is in then is read: contracts fast.
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (int step = 0; step < 6; ++step)
      corners[i] = seen_at(stage.row_time(time_s, corners[i].v))[i];
  }
  return corners;
}

std::vector<std::uint8_t> gray_of(const ColorImage& image) {
  std::vector<std::uint8_t> gray(image.bgr.size() / 3);
  for (std::size_t i = 0; i < gray.size(); ++i) {
    const unsigned sum =
        29U * image.bgr[3 * i] + 150U * image.bgr[3 * i + 1] + 77U * image.bgr[3 * i + 2];
    gray[i] = static_cast<std::uint8_t>((sum + 128U) >> 8U);
  }
  return gray;
}

GrayImage as_gray_image(const std::vector<std::uint8_t>& gray, ImageSize size) {
  return {gray.data(), size.width, size.height, size.width};
}

}  // namespace swarmsmith::film
