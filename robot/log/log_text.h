#pragma once

#include <string>
#include <string_view>

#include "base/text/csv.h"
#include "robot/runtime/run_record.h"

namespace swarmsmith {

/// A robot's log as two texts (docs/robot-runtime.md, "The log"): rows as CSV, the head as TOML.
/// Every number reads back to the same bits.

/// The header line, with its line end.
std::string log_columns();
/// One row, with its line end.
std::string log_line(const LogRow& row);
std::string log_head_text(const LogHead& head);

/// Read the texts that the functions above write; `file` is used in error messages. A last row
/// without a line end was being written when the node died, and is left out.
OrErrors<std::vector<LogRow>> parse_log_rows(std::string_view text, const std::string& file);
OrErrors<LogHead> parse_log_head(std::string_view text, const std::string& file);

}  // namespace swarmsmith
