#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"

namespace swarmsmith {

/// A sheet of paper in portrait, in millimetres.
struct Paper {
  std::string name;
  double width_mm = 0;
  double height_mm = 0;

  friend bool operator==(const Paper&, const Paper&) = default;
};

/// The paper "A4", "A3" or "letter". BadInput for another name.
Expected<Paper> paper_from_name(std::string_view name);
std::vector<std::string> paper_names();

/// The same sheet with width and height exchanged.
Paper turned(const Paper& paper);

}  // namespace swarmsmith
