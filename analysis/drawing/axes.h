#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/drawing/svg.h"

namespace swarmsmith {

/// What plots with axes have in common: ranges, ticks, the frame around the data. Lengths are mm on
/// the page.

/// The values from `low` to `high`; neither is NaN.
struct ValueRange {
  double low = 0;
  double high = 1;

  friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// From the least to the largest; 0 to 1 without a value. Values that are all the same get half a
/// unit, or a tenth of themselves, on both sides, so that there is a range.
ValueRange range_over(const std::vector<double>& values);

/// The distance of round ticks (1, 2 or 5 times a power of ten), so that at most `most` fit.
double tick_step(ValueRange range, std::size_t most);

/// Ticks of an axis, at most.
inline constexpr std::size_t kUsualTicks = 7;

/// Widened to the next round ticks.
ValueRange rounded(ValueRange range, std::size_t most_ticks);

/// The multiples of `step` within the range.
std::vector<double> ticks_in(ValueRange range, double step);

/// With as many decimals as ticks of this step need, and no sign before 0: "0.25", "-380000".
std::string tick_text(double value, double step);

/// A linear map of values to places along one side. `from` is the place of the low end.
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

/// Equal places side by side, for groups that have no order of their own.
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

/// The rectangle that the data are drawn in.
struct PlotArea {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

/// Room for the texts of ticks left of an area.
double tick_room(ValueRange range, std::size_t most_ticks);

/// Bold title and lines of details at the top of a figure. Returns where the rest begins.
double draw_heading(Svg& svg, std::string_view title, const std::vector<std::string>& details);

/// Horizontal lines through the ticks of an axis that goes up, their texts left of the area, and
/// `label` above its upper left corner: texts that stand upright need no turned head. None when
/// empty.
void draw_vertical_axis(Svg& svg, const PlotArea& area, const Axis& axis, std::string_view label);

/// The most ticks of a horizontal axis whose texts do not overlap.
std::size_t ticks_across(const Axis& axis);
/// The line below the area with ticks, their texts and the label below them, if there is one.
void draw_horizontal_axis(Svg& svg, const PlotArea& area, const Axis& axis, std::string_view label);
/// The room that it needs below the area.
inline constexpr double kHorizontalAxisRoom = 9;

/// A line below the area with a text a band. Where they are too wide side by side they are broken
/// at blanks, on at most `kBandLines` lines, written a little smaller when words are still too
/// wide, and shortened then.
void draw_band_axis(Svg& svg, const PlotArea& area, const Bands& bands,
                    const std::vector<std::string>& names);
inline constexpr std::size_t kBandLines = 3;
/// The room that it needs below the area.
double band_axis_room(const Bands& bands, const std::vector<std::string>& names);
/// Whether none of the names is shortened.
bool band_names_fit(const Bands& bands, const std::vector<std::string>& names);

/// The words of a text on lines of at most `width`, `most` of them; what does not fit is shortened.
std::vector<std::string> broken_text(std::string_view text, double size, double width,
                                     std::size_t most);

/// All of a name on lines of at most `width`: broken at blanks, hyphens and underscores, and within
/// a word only where that alone is wider.
std::vector<std::string> whole_lines(std::string_view name, double size, double width);

/// A figure's colour from pale yellow (0) to dark blue (1) that also reads in grey: viridis, turned
/// round, sampled (van der Walt and Smith 2015).
std::string sequential_color(double part);

}  // namespace swarmsmith
