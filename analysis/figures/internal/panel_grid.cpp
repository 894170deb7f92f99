#include "analysis/figures/internal/panel_grid.h"

namespace swarmsmith {

void draw_panel_title(Svg& svg, const std::string& title, double left, double area_top,
                      double width) {
  if (title.empty()) return;
  svg.text({left, area_top - 3}, fitted_text(title, kTextSize * kBolder, width),
           {.size = kTextSize, .bold = true, .fill = std::string(kInk)});
}

}  // namespace swarmsmith
