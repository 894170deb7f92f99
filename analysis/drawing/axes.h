#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// Ranges, ticks and frames for all plots with axes. Lengths are mm on the page.

/// The values from `low` to `high`; neither is NaN.
struct ValueRange {
  double low = 0;
  double high = 1;

  friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// From the smallest to the largest value; 0 to 1 if there are no values. If all values are equal,
/// the range extends by half a unit, or by a tenth of the value, on both sides.
ValueRange range_over(const std::vector<double>& values);

/// The distance of round ticks (1, 2 or 5 times a power of ten), so that at most `most` fit.
double tick_step(ValueRange range, std::size_t most);

/// Maximum number of ticks on an axis.
inline constexpr std::size_t kUsualTicks = 7;

/// The range extended to the next round ticks.
ValueRange rounded(ValueRange range, std::size_t most_ticks);

/// The multiples of `step` within the range.
std::vector<double> ticks_in(ValueRange range, double step);

/// The value with as many decimals as ticks of this step need, without a sign for 0: "0.25",
/// "-380000".
std::string tick_text(double value, double step);

/// A linear map of values to positions along one side. `from` is the position of the low end.
class Axis {
 public:
  Axis(ValueRange range, double from, double to) : range_(range), from_(from), to_(to) {}

  double at(double value) const {
    return from_ + (value - range_.low) / (range_.high - range_.low) * (to_ - from_);
  }
  ValueRange range() const { return range_; }
  double from() const { return from_; }
  double to() const { return to_; }

 private:
  ValueRange range_;
  double from_;
  double to_;
};

/// Bands of equal width side by side, for groups without a natural order.
class Bands {
 public:
  Bands(std::size_t count, double from, double to) : count_(count), from_(from), to_(to) {}

  double width() const { return (to_ - from_) / static_cast<double>(count_ == 0 ? 1 : count_); }
  double centre(std::size_t band) const {
    return from_ + (static_cast<double>(band) + 0.5) * width();
  }
  std::size_t count() const { return count_; }

 private:
  std::size_t count_;
  double from_;
  double to_;
};

/// The rectangle for the data.
struct PlotArea {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

/// The width that tick labels need at the left of an area.
double tick_room(ValueRange range, std::size_t most_ticks);

/// Draws a bold title and lines of details at the top of a figure. Returns where the rest begins.
double draw_heading(Svg& svg, std::string_view title, const std::vector<std::string>& details);

/// Draws horizontal lines through the ticks of a vertical axis, with the tick labels left of the
/// area. `label` is above the upper left corner, horizontal so that it is easy to read; it may be
/// empty.
void draw_vertical_axis(Svg& svg, const PlotArea& area, const Axis& axis, std::string_view label);

/// The maximum number of ticks on a horizontal axis so that their labels do not overlap.
std::size_t ticks_across(const Axis& axis);
/// Draws the line below the area with ticks and their labels, and the label of the axis below them
/// if it has one.
void draw_horizontal_axis(Svg& svg, const PlotArea& area, const Axis& axis, std::string_view label);
/// The height of a horizontal axis below the area.
inline constexpr double kHorizontalAxisRoom = 9;

/// Draws a line below the area with one name per band. Names that are too wide are broken at blanks
/// into at most `kBandLines` lines; if words are still too wide, the names are drawn slightly
/// smaller, and then shortened.
void draw_band_axis(Svg& svg, const PlotArea& area, const Bands& bands,
                    const std::vector<std::string>& names);
inline constexpr std::size_t kBandLines = 3;
/// The height of the band axis below the area.
double band_axis_room(const Bands& bands, const std::vector<std::string>& names);
/// Whether all names fit without being shortened.
bool band_names_fit(const Bands& bands, const std::vector<std::string>& names);

/// The text on at most `most` lines of at most `width`; text that does not fit is shortened.
std::vector<std::string> broken_text(std::string_view text, double size, double width,
                                     std::size_t most);

/// The complete name on lines of at most `width`: broken at blanks, hyphens and underscores, and
/// within a word only if the word alone is wider.
std::vector<std::string> whole_lines(std::string_view name, double size, double width);

/// A colour between pale yellow (0) and dark blue (1) that is also readable in grey: samples of
/// viridis in reverse (van der Walt and Smith 2015).
std::string sequential_color(double part);

}  // namespace swarmsmith
