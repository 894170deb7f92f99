#include "analysis/machines/internal/label_lines.h"

#include <algorithm>
#include <cmath>

#include "analysis/machines/internal/edge_curve.h"

namespace swarmsmith {

LabelSizes label_sizes(double width_mm) {
  if (width_mm < 110) return {.state = 2.2, .condition = 2.1};
  return {.state = 2.6, .condition = 2.4};
}

std::vector<LabelLine> lines_of(const ModuleLabel& label, double size) {
  std::vector<LabelLine> lines;
  for (const std::string& line : label.name)
    lines.push_back({.at = {}, .text = line, .size = size, .is_name = true});
  for (const std::string& line : label.parameters)
    lines.push_back({.at = {}, .text = line, .size = size});
  const double middle = static_cast<double>(lines.size() - 1) / 2;
  for (std::size_t i = 0; i < lines.size(); ++i)
    lines[i].at.y = (static_cast<double>(i) - middle) * kLinePitch * size + kMiddle * size;
  return lines;
}

void move_lines(std::vector<LabelLine>& lines, PagePoint by) {
  for (LabelLine& line : lines)
    line.at = line.at + by;
}

double radius_round(const std::vector<LabelLine>& lines) {
  double radius = 0;
  for (const LabelLine& line : lines) {
    const double x = text_width(line.text, line.size) / 2;
    const double y = std::fabs(line.at.y - kMiddle * line.size) + line.size / 2;
    radius = std::max(radius, std::sqrt(x * x + y * y));
  }
  return radius;
}

double box_width(const std::vector<LabelLine>& lines) {
  double width = 0;
  for (const LabelLine& line : lines)
    width = std::max(width, text_width(line.text, line.size));
  return width + 2 * (kBoxPoint + 0.3);
}

double box_height(const std::vector<LabelLine>& lines) {
  return static_cast<double>(lines.size()) * kLinePitch * lines.front().size + 1;
}

std::array<PagePoint, 6> pointed_box(PagePoint centre, double width, double height) {
  const double x = width / 2;
  const double y = height / 2;
  const PagePoint c = centre;
  return {{{c.x - x, c.y},
           {c.x - x + kBoxPoint, c.y - y},
           {c.x + x - kBoxPoint, c.y - y},
           {c.x + x, c.y},
           {c.x + x - kBoxPoint, c.y + y},
           {c.x - x + kBoxPoint, c.y + y}}};
}

}  // namespace swarmsmith
