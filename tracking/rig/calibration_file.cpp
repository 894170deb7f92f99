#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text/table_reader.h"
#include "base/text/toml_text.h"
#include "sim/files/read_place.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/internal/rig_limits.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

/// Wider than any calibration can be: these limits refuse a number that was damaged or has another
/// unit, with its line. Whether the calibration is good enough is checked afterwards.
constexpr Limits<double> kInPicture{-1e6, 1e6};
constexpr Limits<double> kPixelError{0, 1e5};
constexpr Limits<double> kFloorError{0, 100};
constexpr Limits<double> kTurn{0, 1e5};
constexpr Limits<double> kAngle{-7, 7};
constexpr Limits<double> kDistortion{-1e4, 1e4};
/// The camera is at most this far from the floor's origin, in each direction.
constexpr Limits<double> kTranslation{-300, 300};
constexpr Limits<std::int64_t> kCount{0, 1'000'000};

constexpr Limits<double> kShare{0, 1.0 + 1e-9};

/// A calibration file that is being read; complaints become errors of the configuration.
class File {
 public:
  File(std::string_view text, const std::string& file) : complaints_(file), file_(file) {
    auto document = parse_document(text, file);
    if (!document) {
      Error error = document.error();
      error.message = "E_CONFIG: " + error.message;
      broken_ = error;
    } else {
      document_ = std::move(*document);
    }
  }

  bool is_broken() const { return broken_.has_value(); }
  TableReader root() { return {document_, "", complaints_}; }

  /// The calibration, if the file has no errors and the calibration is usable.
  template <class Calibration, class... Limits>
  OrComplaints<Calibration> finish(Calibration calibration, Limits... limits) {
    std::vector<Error> errors = this->errors();
    if (errors.empty()) {
      errors = faults_of(calibration, limits...);
      for (Error& error : errors)
        error.where = file_;
    }
    if (!errors.empty()) return tl::unexpected(std::move(errors));
    return calibration;
  }

  std::vector<Error> errors() {
    if (broken_) return {*broken_};
    std::vector<Error> errors = complaints_.take();
    for (Error& error : errors) {
      if (error.message.starts_with("E_")) {
        error.kind = ErrorKind::Corrupt;
      } else {
        error.message = "E_CONFIG: " + error.message;
      }
    }
    return errors;
  }

 private:
  Node document_;
  Complaints complaints_;
  std::string file_;
  std::optional<Error> broken_;
};

/// Adds an error if a key is missing.
void need(TableReader& table, const char* key) {
  if (!table.has(key)) table.complain(key, table.name() + " needs `" + key + "`");
}

double number_of(TableReader& table, const char* key, Limits<double> limits) {
  need(table, key);
  return table.number(key, limits).value_or(0);
}

int count_of(TableReader& table, const char* key, Limits<std::int64_t> limits = kCount) {
  need(table, key);
  return static_cast<int>(table.integer(key, limits).value_or(0));
}

std::string text_of(TableReader& table, const char* key) {
  need(table, key);
  return table.text(key).value_or("");
}

/// Reads format and kind, so that a calibration of the wrong kind is reported as such and not by
/// its unknown keys.
bool read_head(TableReader& root, const std::string& kind) {
  read_format(root);
  const std::string found = text_of(root, "kind");
  if (found.empty() || found == kind) return true;
  root.complain("kind", "this is a calibration of kind \"" + found + "\"; expected one of kind \"" +
                            kind + "\"");
  return false;
}

/// The corners of a hull, as alternating u and v; empty for old files, which did not keep the hull.
std::vector<ImagePoint> read_hull(TableReader& table) {
  constexpr std::size_t kMost = 2000;
  const Node* node = table.take("hull");
  if (node == nullptr) return {};
  const auto* array = std::get_if<Array>(&node->value);
  std::vector<double> values;
  for (std::size_t i = 0; array != nullptr && i < array->items.size() && i < kMost; ++i) {
    const auto& value = array->items[i].value;
    if (const auto* real = std::get_if<double>(&value)) values.push_back(*real);
    if (const auto* whole = std::get_if<std::int64_t>(&value))
      values.push_back(static_cast<double>(*whole));
  }
  const auto is_in_reach = [](double value) {
    return value >= kInPicture.least && value <= kInPicture.most;
  };
  const bool good = array != nullptr && values.size() == array->items.size() &&
                    values.size() % 2 == 0 && std::ranges::all_of(values, is_in_reach);
  if (!good) {
    table.complain("hull", "`hull` must be a list of pixels, u and v in turn");
    return {};
  }
  std::vector<ImagePoint> hull;
  for (std::size_t i = 0; i < values.size(); i += 2)
    hull.push_back({values[i], values[i + 1]});
  return hull;
}

/// An array of exactly `count` numbers.
std::vector<double> row_of(TableReader& table, const char* key, std::size_t count,
                           Limits<double> limits) {
  std::vector<double> values(count);
  need(table, key);
  const Node* node = table.take(key);
  if (node == nullptr) return values;
  const auto* array = std::get_if<Array>(&node->value);
  bool good = array != nullptr && array->items.size() == count;
  for (std::size_t i = 0; good && i < count; ++i) {
    const Node& item = array->items[i];
    if (const auto* real = std::get_if<double>(&item.value)) {
      values[i] = *real;
    } else if (const auto* whole = std::get_if<std::int64_t>(&item.value)) {
      values[i] = static_cast<double>(*whole);
    } else {
      good = false;
    }
    good = good && values[i] >= limits.least && values[i] <= limits.most;
  }
  if (!good) {
    table.complain(key, "`" + std::string(key) + "` must be a list of " + std::to_string(count) +
                            " numbers from " + number_text(limits.least) + " to " +
                            number_text(limits.most));
  }
  return values;
}

CameraModel read_model(TableReader& table) {
  static const std::vector<std::string> kLenses{"pinhole", "fisheye"};
  CameraModel model;
  need(table, "width");
  need(table, "height");
  need(table, "lens");
  model.size.width = static_cast<int>(table.integer("width", {16, 65'536}).value_or(16));
  model.size.height = static_cast<int>(table.integer("height", {16, 65'536}).value_or(16));
  model.lens =
      table.choice("lens", kLenses).value_or("") == "fisheye" ? Lens::Fisheye : Lens::Pinhole;
  // From a fisheye lens that sees behind itself to a telescope.
  const double side = std::max(model.size.width, model.size.height);
  const Limits<double> focal{0.05 * side, 100 * side};
  model.fx = number_of(table, "fx", focal);
  model.fy = number_of(table, "fy", focal);
  model.cx = number_of(table, "cx", kInPicture);
  model.cy = number_of(table, "cy", kInPicture);
  const std::size_t count = model.lens == Lens::Fisheye ? 4 : 5;
  const std::vector<double> distortion = row_of(table, "distortion", count, kDistortion);
  std::copy(distortion.begin(), distortion.end(), model.distortion.begin());
  table.finish();
  return model;
}

/// The rows of a rotation matrix have length 1 and are perpendicular, and its determinant is
/// positive (no reflection).
bool is_rotation(const std::array<double, 9>& rows) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> r(rows.data());
  return (r * r.transpose()).isIdentity(1e-6) && r.determinant() > 0;
}

PlaceCalibration::Seen read_seen(TableReader& table) {
  PlaceCalibration::Seen seen;
  seen.tag.tag = count_of(table, "tag", kTagNumber);
  seen.tag.pose = {number_of(table, "x", kCoordinate), number_of(table, "y", kCoordinate),
                   number_of(table, "heading_rad", kAngle)};
  seen.tag.edge_m = number_of(table, "edge", kTagEdge);
  const std::vector<double> corners = row_of(table, "corners", 8, kInPicture);
  for (std::size_t i = 0; i < seen.corners.size(); ++i)
    seen.corners[i] = {corners[2 * i], corners[2 * i + 1]};
  seen.rms_px = number_of(table, "rms_px", kPixelError);
  seen.left_out_m = number_of(table, "left_out_m", kFloorError);
  table.finish();
  return seen;
}

/// Reads the entries of an offset calibration for one tag.
void read_tag(TableReader& table, OffsetCalibration& calibration) {
  calibration.tag = count_of(table, "tag", kTagNumber);
  calibration.edge_m = number_of(table, "edge", kTagEdge);
  calibration.height_m = number_of(table, "height", kTagHeight);
  calibration.offset.x_m = number_of(table, "x", kCoordinate);
  calibration.offset.y_m = number_of(table, "y", kCoordinate);
  need(table, "has_yaw");
  calibration.has_yaw = table.boolean("has_yaw").value_or(false);
  calibration.offset.yaw_rad = number_of(table, "yaw_rad", kAngle);
  calibration.rms_m = number_of(table, "rms_m", kFloorError);
  calibration.sigma_x_m = number_of(table, "sigma_x_m", kFloorError);
  calibration.sigma_y_m = number_of(table, "sigma_y_m", kFloorError);
  calibration.drift_m_s = number_of(table, "drift_m_s", kFloorError);
  calibration.turned_rad = number_of(table, "turned_rad", kTurn);
  calibration.samples = count_of(table, "samples");
}

}  // namespace

OrComplaints<CameraCalibration> parse_camera_calibration(std::string_view text,
                                                         const std::string& file) {
  File read(text, file);
  CameraCalibration calibration;
  if (read.is_broken()) return tl::unexpected(read.errors());
  TableReader root = read.root();
  if (!read_head(root, "camera")) return tl::unexpected(read.errors());
  calibration.made = text_of(root, "made");
  calibration.board = text_of(root, "board");
  calibration.views = count_of(root, "views");
  calibration.views_dropped = count_of(root, "views_dropped");
  calibration.rms_px = number_of(root, "rms_px", kPixelError);
  calibration.worst_view_px = number_of(root, "worst_view_px", kPixelError);
  calibration.coverage = number_of(root, "coverage", kShare);
  calibration.hull = read_hull(root);
  calibration.focal_sigma_px = number_of(root, "focal_sigma_px", kPixelError);
  need(root, "model");
  if (auto model = root.table("model")) calibration.model = read_model(*model);
  root.finish();
  return read.finish(std::move(calibration));
}

OrComplaints<PlaceCalibration> parse_place_calibration(std::string_view text,
                                                       const std::string& file) {
  File read(text, file);
  PlaceCalibration calibration;
  if (read.is_broken()) return tl::unexpected(read.errors());
  TableReader root = read.root();
  if (!read_head(root, "place")) return tl::unexpected(read.errors());
  calibration.made = text_of(root, "made");
  calibration.camera_sha256 = text_of(root, "camera_sha256");
  const std::vector<double> rotation = row_of(root, "rotation", 9, {-2, 2});
  std::copy(rotation.begin(), rotation.end(), calibration.place.rotation.begin());
  const std::vector<double> t = row_of(root, "translation", 3, kTranslation);
  calibration.place.translation = {t[0], t[1], t[2]};
  if (root.complaints() == 0 && !is_rotation(calibration.place.rotation)) {
    root.complain("rotation",
                  "E_CALIB_QUALITY: `rotation` is not a rotation: its rows must have length 1, "
                  "be orthogonal and not mirror; make the file again with "
                  "`swarmsmith track calibrate arena`");
  }
  calibration.rms_px = number_of(root, "rms_px", kPixelError);
  calibration.worst_left_out_m = number_of(root, "worst_left_out_m", kFloorError);
  calibration.worst_tag = count_of(root, "worst_tag", kTagNumber);
  calibration.coverage = number_of(root, "coverage", kShare);
  for (TableReader& seen : root.tables("seen"))
    calibration.tags.push_back(read_seen(seen));
  root.finish();
  // The arena file gives the range of heights, and the place is checked against it elsewhere; here
  // the camera must only be above the floor.
  PlaceLimits limits;
  limits.least_height_m = 0;
  limits.most_height_m = kCameraHeight.most;
  return read.finish(std::move(calibration), limits);
}

OrComplaints<OffsetCalibration> parse_offset_calibration(std::string_view text,
                                                         const std::string& file) {
  File read(text, file);
  OffsetCalibration calibration;
  if (read.is_broken()) return tl::unexpected(read.errors());
  TableReader root = read.root();
  if (!read_head(root, "offset")) return tl::unexpected(read.errors());
  calibration.made = text_of(root, "made");
  calibration.robot = text_of(root, "robot");
  read_tag(root, calibration);
  for (TableReader& table : root.tables("more_tags")) {
    OffsetCalibration& tag = calibration.more_tags.emplace_back();
    tag.robot = calibration.robot;
    tag.made = calibration.made;
    read_tag(table, tag);
    table.finish();
  }
  root.finish();
  // The file does not say what kind of robot it is; `track_run` compares it with the mission's.
  OffsetLimits limits;
  limits.most_offset_m = std::numeric_limits<double>::infinity();
  return read.finish(std::move(calibration), limits);
}

}  // namespace swarmsmith
