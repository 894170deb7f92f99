#include "irace_core/search/stage.h"

namespace swarmsmith {
namespace {

/// The point, filled in from options and budget if no event has reported it. A search that was
/// extended has another plan, so its point is not filled in.
template <class Kind>
SearchPoint as_planned(const Kind& kind, const SearchPoint& point) {
  if constexpr (requires { kind.planned(point); }) {
    if (point.iterations == 0 && point.finals == 0) return kind.planned(point);
  }
  return point;
}

StageTexts texts_of(const SearchOptions& options, const SearchPoint& known) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) {
        const SearchPoint point = as_planned(kind, known);
        if (point.is_final && !Kind::kWords.has_tests)
          return usual_texts(Kind::kWords, point, "final stage");
        if constexpr (requires { kind.texts(point); }) {
          return kind.texts(point);
        } else {
          // Final stages are not counted; a search that was extended has several.
          const std::int64_t number =
              Kind::kWords.has_tests ? point.iteration : point.iteration - point.finals;
          return usual_texts(Kind::kWords, point,
                             std::string(Kind::kWords.round) + " " + std::to_string(number));
        }
      },
      options);
}

}  // namespace

std::string round_name(const SearchOptions& options, const SearchPoint& known) {
  return texts_of(options, known).name;
}

std::string round_line(const SearchOptions& options, const SearchPoint& known) {
  return texts_of(options, known).line;
}

std::string stage_text(const SearchOptions& options, const SearchPoint& known) {
  if (known.iteration == 0) return "";
  return texts_of(options, known).stage;
}

}  // namespace swarmsmith
