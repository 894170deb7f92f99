#pragma once

#include <string>

#include "sim/assessment/assessment.h"

namespace swarmsmith::cli {

/// The report as tables of at most 100 columns: checks, notes about the checks, rates, a summary.
std::string assessment_text(const assessment::Report& report, const assessment::Subject& subject);

/// The report as one JSON object on one line: flavour, profile, robot, passed, and an array of
/// modules.
std::string assessment_json(const assessment::Report& report, const assessment::Subject& subject);

}  // namespace swarmsmith::cli
