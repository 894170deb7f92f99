#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "tracking/printing/paper.h"

namespace swarmsmith {

/// Tags to print and cut out.
struct TagSheetOptions {
  std::string family = "tag36h11";
  std::vector<int> ids;
  double edge_m = 0.1;  ///< of the square between the corners that a detector finds
  Paper paper;
};

/// The edges that can be asked for, metres.
inline constexpr double kLeastPrintedEdge_m = 0.015;
inline constexpr double kMostPrintedEdge_m = 1;

/// Ids from "1-3,100-105": in that order, each once. BadInput with the part that is not an id.
Expected<std::vector<int>> ids_from_text(std::string_view text);

/// Pages as SVG in true scale, as many tags on each as fit, on the paper standing or lying. Around
/// each quiet zone there are marks to cut at; below it a strip, which may be left on, names the
/// tag and shows its x axis and its upper side.
///
/// BadInput: family or id not known, no id, an edge that is too large for the paper (with the
/// largest that fits).
Expected<std::vector<std::string>> tag_sheets(const TagSheetOptions& options);

}  // namespace swarmsmith
