#include "analysis/figures/design_choice.h"

#include <array>
#include <utility>

#include <fmt/format.h>

namespace swarmsmith {

Expected<void> check_options(const FigureOptions& options, std::string_view name,
                             const DesignQuestions& takes) {
  const std::array<std::pair<bool, std::string_view>, 5> refused = {
      {{!options.by.empty(), "--by"},
       {!options.source.empty(), "--source"},
       {options.candidate.has_value(), "--candidate"},
       {options.iteration.has_value() && !takes.iteration, "--iteration"},
       {!options.parameter.empty() && !takes.parameter, "--parameter"}}};
  for (const auto& [is_given, option] : refused) {
    if (is_given)
      return bad_input(fmt::format("the figure {} takes no {}: leave it out", name, option));
  }
  return {};
}

Expected<DesignRecord> chosen_design(StoreReader& store, const FigureOptions& options,
                                     std::string_view name, const DesignQuestions& takes) {
  const auto fine = check_options(options, name, takes);
  if (!fine) return Unexpected(fine.error());
  auto found = designs(store, options.filter);
  if (!found) return Unexpected(found.error());
  if (found->empty()) {
    return unexpected(ErrorKind::NotFound,
                      "the store has no such design; `swarmsmith ls designs` shows what it has");
  }
  if (found->size() > 1) {
    return bad_input(fmt::format(
        "the figure {} shows one design, and there are {}: choose one, such as --design {}", name,
        found->size(), to_string(found->front().design)));
  }
  return std::move(found->front());
}

std::string title_of(const DesignRecord& design) {
  return design.mission + ", " + design.method;
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"') quoted += '"';
    quoted += letter;
  }
  return quoted + "\"";
}

}  // namespace swarmsmith
