#include "analysis/arena/arena_panels.h"

#include <algorithm>

#include <fmt/format.h>

#include "analysis/arena/internal/arena_drawing.h"
#include "analysis/drawing/axes.h"
#include "analysis/drawing/figure_style.h"
#include "base/plain_text.h"

namespace swarmsmith {

std::string draw(const ArenaPanels& panels) {
  const std::size_t count = panels.pictures.size();
  const auto fit = static_cast<std::size_t>(panels.width_mm / kLeastPictureWidth_mm);
  const std::size_t columns = std::clamp<std::size_t>(fit, 1, std::max<std::size_t>(1, count));
  const double width = panels.width_mm / static_cast<double>(columns);
  std::vector<Svg> drawings;
  for (ArenaPicture picture : panels.pictures) {
    picture.width_mm = width;
    drawings.push_back(drawing_of(picture));
  }
  const double top =
      kMargin + kTitleSize + kLineHeight * static_cast<double>(panels.details.size()) + 1;
  std::vector<PagePoint> places;
  double y = top;
  double tallest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && i % columns == 0) {
      y += tallest;
      tallest = 0;
    }
    tallest = std::max(tallest, drawings[i].height());
    places.push_back({width * static_cast<double>(i % columns), y});
  }
  Svg svg(panels.width_mm, y + tallest, panels.title, counted(count, "run") + " from above");
  draw_heading(svg, panels.title, panels.details);
  for (std::size_t i = 0; i < count; ++i)
    svg.add(drawings[i], places[i]);
  return svg.finish();
}

}  // namespace swarmsmith
