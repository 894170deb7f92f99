#include "tracking/printing/survey_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/figure_style.h"
#include "base/plain_text.h"
#include "tracking/geometry/tag_family.h"
#include "tracking/printing/internal/page.h"
#include "tracking/printing/tag_sheet.h"

namespace swarmsmith {
namespace {

constexpr double kPicture = 112;  ///< side of the arena's drawing
constexpr double kTop = kPageMargin + 14;
constexpr double kRow = 7;
constexpr double kThin = 0.2;
constexpr double kThick = 0.5;
const std::string& ink_text() {
  static const std::string text(kInk);
  return text;
}

double distance_to_line(const Wall& wall) {
  const double dx = wall.to.x - wall.from.x;
  const double dy = wall.to.y - wall.from.y;
  return std::abs(wall.from.x * dy - wall.from.y * dx) / std::sqrt(dx * dx + dy * dy);
}

/// Converts metres (y up) to positions on the page.
class Plan {
 public:
  Plan(const Arena& arena, PagePoint top_left) {
    double most = 0;
    for (const Point& corner : corners_of(arena))
      most = std::max({most, std::abs(corner.x), std::abs(corner.y)});
    scale_ = kPicture / 2 / most;
    centre_ = {top_left.x + kPicture / 2, top_left.y + kPicture / 2};
  }
  PagePoint at(double x, double y) const {
    return {centre_.x + scale_ * x, centre_.y - scale_ * y};
  }
  double scale() const { return scale_; }

 private:
  PagePoint centre_;
  double scale_ = 1;
};

void draw_square(Svg& svg, const Plan& plan, const Pose& pose, double side) {
  const double c = std::cos(pose.theta) * side / 2;
  const double s = std::sin(pose.theta) * side / 2;
  const std::array<PagePoint, 4> corners = {
      {plan.at(pose.x - c + s, pose.y - s - c), plan.at(pose.x + c + s, pose.y + s - c),
       plan.at(pose.x + c - s, pose.y + s + c), plan.at(pose.x - c - s, pose.y - s + c)}};
  svg.polygon(corners, filled(kInk));
}

void draw_arena(Svg& svg, const SurveySheetOptions& options, const std::vector<Pose>& places) {
  const Plan plan(options.arena, {kPageMargin, kTop});
  std::vector<PagePoint> walls;
  for (const Point& corner : corners_of(options.arena))
    walls.push_back(plan.at(corner.x, corner.y));
  svg.polygon(walls, stroked(kInk, kThick));
  const double axis = 30 / plan.scale();
  draw_arrow(svg, plan.at(0, 0), plan.at(axis, 0), kThin * 2);
  draw_arrow(svg, plan.at(0, 0), plan.at(0, axis), kThin * 2);
  const PagePoint origin = plan.at(0, 0);
  svg.text({origin.x + 31, origin.y + 1}, "x", {.size = kTextSize, .fill = ink_text()});
  svg.text({origin.x - 0.8, origin.y - 31.5}, "y", {.size = kTextSize, .fill = ink_text()});
  svg.text({origin.x - 1, origin.y + 4}, "(0, 0)",
           {.size = kTextSize, .anchor = TextStyle::Anchor::End, .fill = ink_text()});
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Pose& place = places[i];
    draw_square(svg, plan, place, options.edge_m);
    // Labels are nearer to the middle, where there is room.
    const double radius = std::hypot(place.x, place.y);
    const double inwards = 1 - (options.edge_m * 0.75 + 5 / plan.scale()) / radius;
    const PagePoint at = plan.at(place.x * inwards, place.y * inwards);
    svg.text({at.x, at.y + 1}, std::to_string(options.ids[i]),
             {.size = kTitleSize,
              .anchor = TextStyle::Anchor::Middle,
              .bold = true,
              .fill = ink_text()});
  }
}

/// Draws a tag with numbered corners and its axis, and the quantities to measure.
void draw_explanation(Svg& svg, const SurveySheetOptions& options, double width) {
  const double left = kPageMargin + kPicture + 8;
  constexpr double kSide = 26;
  const double top = kTop + 8;
  const double middle = left + (width - kPicture - 8) / 2;
  const double x0 = middle - kSide / 2;
  const std::array<PagePoint, 4> tag = {
      {{x0, top}, {x0 + kSide, top}, {x0 + kSide, top + kSide}, {x0, top + kSide}}};
  svg.polygon(tag, {.fill = "#e6e6e6", .stroke = ink_text(), .width = kThick});
  const TextStyle number = {
      .size = kTitleSize, .anchor = TextStyle::Anchor::Middle, .fill = ink_text()};
  svg.text({x0 + 3, top + kSide - 2}, "1", number);
  svg.text({x0 + kSide - 3, top + kSide - 2}, "2", number);
  svg.text({x0 + kSide - 3, top + 4.5}, "3", number);
  svg.text({x0 + 3, top + 4.5}, "4", number);
  const PagePoint centre = {middle, top + kSide / 2};
  svg.circle(centre, 0.7, filled(kInk));
  draw_arrow(svg, centre, {x0 + kSide + 6, centre.y}, kThin * 2);
  svg.text({x0 + kSide + 7.5, centre.y + 1}, "x", {.size = kTextSize, .fill = ink_text()});
  const std::string edge = printed_mm(options.edge_m);
  const std::vector<std::string> lines = {"A tag as it is printed, its",
                                          "\"up\" at the top. Corners of the",
                                          "black border: 1 bottom left,",
                                          "2 bottom right, 3 top right,",
                                          "4 top left.",
                                          "",
                                          "Measure from the arena's middle",
                                          "to the tag's middle: x and y in",
                                          "metres, to 1 mm. The angle is",
                                          "that of the tag's x axis against",
                                          "the arena's, in degrees, positive",
                                          "against the clock. By a laser or",
                                          "by tape: corner 1 and 2; the",
                                          "angle is the direction from",
                                          "1 to 2.",
                                          "",
                                          "Measure the black border: it",
                                          fmt::format("should be {} mm.", edge)};
  double y = top + kSide + 8;
  for (const std::string& line : lines) {
    svg.text({left, y}, line, {.size = kTextSize, .fill = ink_text()});
    y += line.empty() ? kLineHeight / 2 : kLineHeight;
  }
}

void draw_table(Svg& svg, const SurveySheetOptions& options, const std::vector<Pose>& places,
                double top, double width) {
  const std::array<std::string_view, 7> titles = {
      "tag", "proposed x, y", "x (m)", "y (m)", "angle (deg)", "edge (mm)", "again by another"};
  const std::array<double, 7> parts = {0.07, 0.17, 0.14, 0.14, 0.14, 0.14, 0.20};
  const double bottom = top + kRow * static_cast<double>(options.ids.size() + 1);
  double x = kPageMargin;
  for (std::size_t column = 0; column < titles.size(); ++column) {
    svg.text({x + 1.5, top + kRow - 2.2}, titles[column],
             {.size = kTextSize, .bold = true, .fill = ink_text()});
    const std::array<PagePoint, 2> edge = {{{x, top}, {x, bottom}}};
    svg.line(edge, stroked(kInk, kThin));
    for (std::size_t i = 0; i < options.ids.size() && column < 2; ++i) {
      const std::string text = column == 0
                                   ? std::to_string(options.ids[i])
                                   : fmt::format("{:.3f}, {:.3f}", places[i].x, places[i].y);
      svg.text({x + 1.5, top + kRow * static_cast<double>(i + 2) - 2.2}, text,
               {.size = kTextSize, .fill = ink_text()});
    }
    x += parts[column] * width;
  }
  const std::array<PagePoint, 2> last = {{{x, top}, {x, bottom}}};
  svg.line(last, stroked(kInk, kThin));
  for (std::size_t i = 0; i < options.ids.size() + 2; ++i) {
    const double y = top + kRow * static_cast<double>(i);
    const std::array<PagePoint, 2> line = {{{kPageMargin, y}, {x, y}}};
    svg.line(line, stroked(kInk, kThin));
  }
}

/// Distances from a corner of the walls' polygon to the following corners, for checking with a
/// tape.
std::string corner_distances(const Arena& arena) {
  const std::vector<Point> corners = corners_of(arena);
  std::string text;
  for (std::size_t k = 1; k <= corners.size() / 2; ++k) {
    text += fmt::format("{}{:.3f}", k == 1 ? "" : ", ",
                        std::hypot(corners[k].x - corners[0].x, corners[k].y - corners[0].y));
  }
  return text;
}

/// The side of a tag with its quiet zone.
double side_of(double edge_m) {
  return 1.25 * edge_m;
}

/// Whether the tags lie within the walls, and none over another.
bool have_room(const std::vector<Pose>& places, const SurveySheetOptions& options) {
  const double side = side_of(options.edge_m);
  for (const Pose& place : places) {
    for (const double x : {-side / 2, side / 2})
      for (const double y : {-side / 2, side / 2})
        if (!is_inside(options.arena, {place.x + x, place.y + y})) return false;
    for (const Pose& other : places) {
      if (&other != &place && std::abs(place.x - other.x) < side &&
          std::abs(place.y - other.y) < side)
        return false;
    }
  }
  return true;
}

/// Why no form can be made for these tags and this arena.
std::optional<Error> flaw_of(const SurveySheetOptions& options) {
  const auto flaw = [](std::string text, std::string option) {
    return Error{ErrorKind::BadInput, std::move(text), std::move(option)};
  };
  if (options.ids.empty()) return flaw("no ids; write them as 100-105", "--ids");
  int tags = 0;
  for (const TagFamily& family : known_tag_families())
    tags = std::max(tags, family.tags);
  for (const int id : options.ids) {
    if (id >= tags) return flaw(fmt::format("no family has a tag {}", id), "--ids");
  }
  if (!(options.edge_m >= kLeastPrintedEdge_m && options.edge_m <= kMostPrintedEdge_m)) {
    return flaw(fmt::format("{} m is not from {} to {} m", options.edge_m, kLeastPrintedEdge_m,
                            kMostPrintedEdge_m),
                "--edge");
  }
  // Arena files take places up to this distance.
  constexpr double kMost_m = 100;
  double most = 0;
  for (const Point& corner : corners_of(options.arena)) {
    const double reach = std::hypot(corner.x, corner.y);
    if (!(reach <= most)) most = reach;
  }
  if (most <= kMost_m) return std::nullopt;
  return flaw(
      fmt::format("the arena reaches to {:.4g} m from its middle, limit {:g} m", most, kMost_m),
      "--area");
}

}  // namespace

std::vector<Pose> suggested_places(const Arena& arena, std::size_t tags, double edge_m) {
  double inradius = distance_to_line(arena.walls.front());
  for (const Wall& wall : arena.walls)
    inradius = std::min(inradius, distance_to_line(wall));
  // Half of the diagonal of the tag with its quiet zone, and two centimetres from the wall.
  const double radius = inradius - side_of(edge_m) * std::numbers::sqrt2 / 2 - 0.02;
  std::vector<Pose> places;
  for (std::size_t i = 0; i < tags; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(tags);
    places.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return places;
}

Expected<std::string> survey_sheet(const SurveySheetOptions& options) {
  if (auto flaw = flaw_of(options)) return tl::unexpected(std::move(*flaw));
  const double width = options.paper.width_mm - 2 * kPageMargin;
  const double table_top = kTop + kPicture + 12;
  const double room = options.paper.height_mm - kPageMargin - kFootHeight - 2 - table_top;
  const auto most = static_cast<std::size_t>(room / kRow) - 1;
  if (options.ids.size() > most) {
    return bad_input(fmt::format("{} tags, but the form has {} lines; print two forms",
                                 options.ids.size(), most),
                     "--ids");
  }
  const std::vector<Pose> places =
      suggested_places(options.arena, options.ids.size(), options.edge_m);
  if (!have_room(places, options)) {
    const bool is_one = options.ids.size() == 1;
    return bad_input(fmt::format("{} of {} m {} not fit into the arena; use smaller tags{}",
                                 counted(options.ids.size(), "tag"), options.edge_m,
                                 is_one ? "does" : "do", is_one ? "" : ", or fewer"),
                     "--edge");
  }
  Svg svg = empty_page(options.paper, "Survey of the floor tags", "A form to fill in");
  svg.text({kPageMargin, kPageMargin + 4}, "Survey of the floor tags",
           {.size = 5, .bold = true, .fill = ink_text()});
  svg.text({options.paper.width_mm - kPageMargin, kPageMargin + 4},
           "Arena ____________  date ____________  by ____________",
           {.size = kTextSize, .anchor = TextStyle::Anchor::End, .fill = ink_text()});
  draw_arena(svg, options, places);
  draw_explanation(svg, options, width);
  svg.text({kPageMargin, kTop + kPicture + 8},
           "From a corner to the next ones (m): " + corner_distances(options.arena),
           {.size = kTextSize, .fill = ink_text()});
  draw_table(svg, options, places, table_top, width);
  draw_foot(svg, options.paper, "survey of floor tags");
  return svg.finish();
}

}  // namespace swarmsmith
