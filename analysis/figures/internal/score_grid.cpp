#include "analysis/figures/internal/score_grid.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "analysis/drawing/legend.h"
#include "analysis/figures/internal/store_names.h"

namespace swarmsmith {
namespace {

constexpr double kLeastColumn = 17;
constexpr double kGap = 3.5;
constexpr double kMostNamePart = 0.3;
constexpr double kNameLine = 3.2;
constexpr double kRow = 11;
constexpr double kLeastRow = 4.5;
constexpr double kPage = 240;
constexpr double kAxisRoom = 7;
constexpr double kBars = 0.9;
constexpr double kBeforeArea = 1.5;
constexpr std::string_view kHow = "Bars: share of the scores of a method and source, %";

/// A column: a mission's bins, and the share that fills the height of a row.
struct Column {
  const ScorePanel* panel = nullptr;
  ScoreBins bins;
  double most = 0;

  ValueRange range() const {
    const double low = bins.single ? bins.low - 0.5 : bins.low;
    return {low, low + bins.width * static_cast<double>(bins.count)};
  }
  std::vector<double> shares(const ScoreGroup& group) const {
    std::vector<double> shares(bins.count, 0);
    for (const double value : group.values)
      shares[bins.bin_of(value)] += 100 / static_cast<double>(group.values.size());
    return shares;
  }
};

Column column_of(const ScorePanel& panel) {
  std::vector<double> all;
  for (const ScoreGroup& group : panel.groups)
    all.insert(all.end(), group.values.begin(), group.values.end());
  Column column{.panel = &panel, .bins = score_bins(all)};
  for (const ScoreGroup& group : panel.groups)
    column.most = std::max(column.most, std::ranges::max(column.shares(group)));
  return column;
}

std::vector<std::string> methods_of(const ScoreDistribution& plot) {
  std::vector<std::string> methods;
  for (const ScorePanel& panel : plot.panels) {
    for (const ScoreGroup& group : panel.groups) {
      if (std::ranges::find(methods, group.method) == methods.end())
        methods.push_back(group.method);
    }
  }
  std::ranges::sort(methods);
  return methods;
}

class ScoreGrid {
 public:
  ScoreGrid(const ScoreDistribution& plot, const std::vector<std::string>& sources)
      : plot_(plot), sources_(sources), methods_(methods_of(plot)) {
    for (const std::string& method : methods_)
      names_ = std::max(names_, text_width(method, kTextSize));
    names_ = std::min(names_, kMostNamePart * plot.width_mm);
    const double room = plot.width_mm - 2 * kMargin - names_;
    across_ = std::clamp<std::size_t>(static_cast<std::size_t>(room / (kLeastColumn + kGap)), 1,
                                      plot.panels.size());
    column_ = room / static_cast<double>(across_) - kGap;
    const auto rows = static_cast<double>(methods_.size() * bands());
    row_ = std::clamp((kPage - 40) / rows - 1, kLeastRow, kRow);
  }

  std::string svg() const {
    const double top = kMargin + (plot_.title.empty() ? 0 : kTitleSize) +
                       kLineHeight * static_cast<double>(plot_.details.size() + 1) + 2;
    std::vector<LegendEntry> entries;
    for (const std::string& source : drawn_sources())
      entries.push_back({distinct_color(place_of(sources_, source)), source});
    const Legend legend(entries, plot_.width_mm - 2 * kMargin);
    const double bottom = top + band_height() * static_cast<double>(bands());
    Svg svg(plot_.width_mm, bottom + legend.height() + kMargin, plot_.title,
            fmt::format("Histograms of scores, {} methods by {} missions", methods_.size(),
                        plot_.panels.size()));
    const double below = draw_heading(svg, plot_.title, plot_.details);
    svg.text({kMargin, below + kTextSize}, fitted_text(kHow, kTextSize, plot_.width_mm - 4),
             ink(TextStyle::Anchor::Start));
    for (std::size_t band = 0; band < bands(); ++band)
      draw_band(svg, band, top + band_height() * static_cast<double>(band));
    legend.draw(svg, bottom);
    return svg.finish();
  }

 private:
  std::size_t bands() const { return (plot_.panels.size() + across_ - 1) / across_; }
  /// The mission's full name above its column.
  std::vector<std::string> title_lines(const std::string& title) const {
    return whole_lines(title, kTextSize * kBolder, column_ + kGap - 1);
  }
  double head() const {
    std::size_t most = 1;
    for (const ScorePanel& panel : plot_.panels)
      most = std::max(most, title_lines(panel.title).size());
    return kLineHeight * static_cast<double>(most) + kTextSize;
  }
  double band_height() const {
    return head() + (row_ + 1) * static_cast<double>(methods_.size()) + kAxisRoom;
  }
  std::vector<std::string> drawn_sources() const {
    std::vector<std::string> drawn;
    for (const std::string& source : sources_) {
      const bool is_drawn = std::ranges::any_of(plot_.panels, [&](const ScorePanel& panel) {
        return std::ranges::find(panel.groups, source, &ScoreGroup::source) != panel.groups.end();
      });
      if (is_drawn) drawn.push_back(source);
    }
    return drawn;
  }

  void draw_band(Svg& svg, std::size_t band, double top) const {
    const double first = top + head();
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const auto lines = whole_lines(methods_[m], kTextSize, names_ + 0.01);
      double y = first + (row_ + 1) * static_cast<double>(m) + row_ / 2 + 0.36 * kTextSize -
                 kNameLine * static_cast<double>(lines.size() - 1) / 2;
      for (const std::string& line : lines) {
        svg.text({kMargin, y}, line, ink(TextStyle::Anchor::Start));
        y += kNameLine;
      }
    }
    const std::size_t from = band * across_;
    for (std::size_t i = from; i < std::min(from + across_, plot_.panels.size()); ++i)
      draw_column(
          svg, column_of(plot_.panels[i]), first,
          kMargin + names_ + kBeforeArea + (column_ + kGap) * static_cast<double>(i - from));
  }

  void draw_column(Svg& svg, const Column& column, double first, double left) const {
    const auto lines = title_lines(column.panel->title);
    TextStyle bold = ink(TextStyle::Anchor::Start);
    bold.bold = true;
    double y = first - kLineHeight * static_cast<double>(lines.size()) + 1;
    for (const std::string& line : lines) {
      svg.text({left, y}, line, bold);
      y += kLineHeight;
    }
    PlotArea area{.left = left, .top = first, .width = column_, .height = row_};
    for (const std::string& method : methods_) {
      draw_cell(svg, column, method, area);
      area.top += row_ + 1;
    }
    area.top -= row_ + 1;
    draw_axis(svg, column.range(), area);
  }

  /// Thousands are abbreviated, and labels stay within the column, because the next column begins
  /// right beside it.
  static void draw_axis(Svg& svg, ValueRange range, const PlotArea& area) {
    constexpr double kThousand = 1000;
    constexpr std::size_t kTicks = 3;
    const Axis x(range, area.left, area.right());
    const double step = tick_step(range, kTicks);
    double free = area.left - 2;
    for (const double tick : ticks_in(range, step)) {
      const std::array<PagePoint, 2> mark = {PagePoint{x.at(tick), area.bottom()},
                                             PagePoint{x.at(tick), area.bottom() + 1}};
      svg.line(mark, stroked(kInk, 0.2));
      const std::string text = step < kThousand
                                   ? tick_text(tick, step)
                                   : tick_text(tick / kThousand, step / kThousand) + "k";
      const double half = text_width(text, kTextSize) / 2;
      const double at = std::clamp(x.at(tick), area.left - 1 + half, area.right() + 1 - half);
      if (at - half < free) continue;
      free = at + half + 0.5;
      svg.text({at, area.bottom() + 1 + kTextSize}, text, ink(TextStyle::Anchor::Middle));
    }
  }

  void draw_cell(Svg& svg, const Column& column, const std::string& method,
                 const PlotArea& area) const {
    std::vector<const ScoreGroup*> groups;
    for (const ScoreGroup& group : column.panel->groups) {
      if (group.method == method) groups.push_back(&group);
    }
    const Bands bands(column.bins.count, area.left, area.right());
    const double bar =
        kBars * bands.width() / static_cast<double>(std::max<std::size_t>(1, groups.size()));
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const auto shares = column.shares(*groups[g]);
      for (std::size_t bin = 0; bin < shares.size(); ++bin) {
        if (shares[bin] == 0) continue;
        const double x =
            bands.centre(bin) - kBars * bands.width() / 2 + static_cast<double>(g) * bar;
        const double height = area.height * shares[bin] / column.most;
        const std::array<PagePoint, 4> box = {{{x, area.bottom() - height},
                                               {x + bar, area.bottom() - height},
                                               {x + bar, area.bottom()},
                                               {x, area.bottom()}}};
        svg.polygon(box, filled(distinct_color(place_of(sources_, groups[g]->source))));
      }
    }
    const std::array<PagePoint, 2> line = {PagePoint{area.left, area.bottom()},
                                           PagePoint{area.right(), area.bottom()}};
    svg.line(line, stroked(kInk, 0.15));
  }

  const ScoreDistribution& plot_;
  const std::vector<std::string>& sources_;
  std::vector<std::string> methods_;
  double names_ = 0;
  double column_ = kLeastColumn;
  double row_ = kRow;
  std::size_t across_ = 1;
};

}  // namespace

std::string draw_score_grid(const ScoreDistribution& plot,
                            const std::vector<std::string>& sources) {
  return ScoreGrid(plot, sources).svg();
}

}  // namespace swarmsmith
