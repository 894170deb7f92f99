#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"
#include "programs/target.h"

namespace swarmsmith {

/// The values in a program's output.
struct Reading {
  double cost = 0;  ///< smaller is better; may be infinite, never NaN; 0 before a targetEvaluator
  double time = 0;  ///< at least min_measurable_time, above 0; 0 if the program does not print it

  friend bool operator==(const Reading&, const Reading&) = default;
};

/// Output of a targetRunner: cost, or cost and time; before a targetEvaluator nothing, or a time
/// (irace facts, 18.2); with aclib the line of GenericWrapper4AC (18.5). `bound` is the run's
/// maximum time, 0 if there is none. The error says what was printed and what is expected.
Expected<Reading> parse_runner_output(std::string_view output, const Target& target,
                                      double bound = 0);

/// Output of a targetEvaluator: the cost; in batch mode a time may follow (18.4).
Expected<Reading> parse_evaluator_output(std::string_view output, const Target& target);

/// The job's id, which must be the only output of a targetRunner in batch mode.
Expected<std::string> parse_job_id(std::string_view output);

/// The text in a form for people: control characters become escapes (base/shown_text.h), and only
/// the end of a long text is kept, after "...".
std::string printable(std::string_view text, std::size_t longest);

}  // namespace swarmsmith
