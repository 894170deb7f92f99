#include "tracking/printing/paper.h"

#include <array>
#include <utility>

#include "base/suggestion.h"

namespace swarmsmith {
namespace {

struct KnownPaper {
  std::string_view name;
  double width_mm;
  double height_mm;
};

/// From ISO 216 and ANSI/ASME Y14.1.
constexpr std::array<KnownPaper, 3> kPapers = {
    {{"A4", 210, 297}, {"A3", 297, 420}, {"letter", 215.9, 279.4}}};

}  // namespace

Expected<Paper> paper_from_name(std::string_view name) {
  for (const KnownPaper& paper : kPapers) {
    if (paper.name == name) return Paper{std::string(name), paper.width_mm, paper.height_mm};
  }
  return bad_input("\"" + std::string(name) + "\" is not one of: " + joined(paper_names()),
                   "paper");
}

std::vector<std::string> paper_names() {
  std::vector<std::string> names;
  names.reserve(std::size(kPapers));
  for (const KnownPaper& paper : kPapers)
    names.emplace_back(paper.name);
  return names;
}

Paper turned(const Paper& paper) {
  return {paper.name, paper.height_mm, paper.width_mm};
}

}  // namespace swarmsmith
