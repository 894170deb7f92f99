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
  double edge_m = 0.1;  ///< edge of the square between the corners that a detector finds
  Paper paper;
};

/// Limits of the edge, in metres.
inline constexpr double kLeastPrintedEdge_m = 0.015;
inline constexpr double kMostPrintedEdge_m = 1;

/// Reads ids such as "1-3,100-105"; keeps their order, each once. BadInput with the part that is
/// not an id.
Expected<std::vector<int>> ids_from_text(std::string_view text);

/// Pages as SVG in true scale, with as many tags on each as fit, in portrait or landscape. Marks
/// around each quiet zone show where to cut; a strip below it, which may be left on, shows the
/// tag's name, its x axis and its upper side.
///
/// BadInput for an unknown family or id, without ids, or if the edge is too large for the paper
/// (the error gives the largest that fits).
Expected<std::vector<std::string>> tag_sheets(const TagSheetOptions& options);

}  // namespace swarmsmith
