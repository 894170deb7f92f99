#pragma once

#include <string>
#include <vector>

namespace swarmsmith {

/// What stands on the page of a figure, read from its SVG: texts with the rectangles that they are
/// estimated to fill, and the bars of its matrices. Lengths in mm.
struct DrawnPage {
  struct Text {
    std::string text;
    double left = 0, right = 0, top = 0, bottom = 0;
  };
  struct Bar {
    std::string color;
    double thickness = 0;
    double x = 0, y = 0;  ///< where it begins
    double length = 0;
    bool goes_down = false;
  };
  double width = 0, height = 0;
  std::vector<Text> texts;
  std::vector<Bar> bars;
  std::vector<std::string> paths;  ///< elements of all other shapes with a path

  bool has_text(const std::string& text) const;
  /// The bars of a colour.
  std::vector<Bar> bars_of(const std::string& color) const;
  /// A sentence for each text that leaves the page or stands on another one.
  std::vector<std::string> collisions() const;
};

DrawnPage drawn_page(const std::string& svg);

}  // namespace swarmsmith
