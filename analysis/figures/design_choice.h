#pragma once

#include <string_view>

#include "analysis/figures/figure.h"

namespace swarmsmith {

/// What a kind of figure that shows one design's races can be asked besides the design.
struct DesignQuestions {
  bool iteration = false;
  bool parameter = false;
};

/// The one design that the filter leaves. Errors: BadInput when it leaves several, or when
/// `options` has something that the kind `name` does not take; NotFound without one.
Expected<DesignRecord> chosen_design(StoreReader& store, const FigureOptions& options,
                                     std::string_view name, const DesignQuestions& takes);

/// "aggregation, watermelon"
std::string title_of(const DesignRecord& design);

/// Errors: BadInput when `options` asks for what only other kinds than `name` have.
Expected<void> check_options(const FigureOptions& options, std::string_view name,
                             const DesignQuestions& takes);

/// A cell of a CSV: quoted where it has to be (RFC 4180).
std::string csv_cell(std::string_view text);

}  // namespace swarmsmith
