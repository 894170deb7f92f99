#pragma once

#include <string>
#include <string_view>

#include "sim/assessment/assessment.h"

namespace swarmsmith::cli {

/// The report as tables of at most 100 columns: checks, notes about them, rates, a summary.
std::string assessment_text(const assessment::Report& report, std::string_view flavour,
                            std::string_view profile);

/// The report as one JSON object on one line: flavour, profile, passed, and an array of modules.
std::string assessment_json(const assessment::Report& report, std::string_view flavour,
                            std::string_view profile);

}  // namespace swarmsmith::cli
