#pragma once

#include <string>
#include <string_view>

#include "base/expected.h"
#include "programs/target.h"

namespace swarmsmith {

/// What a program's output says.
struct Reading {
  double cost = 0;  ///< smaller is better, perhaps infinite, no NaN; 0 before a targetEvaluator
  double time = 0;  ///< above 0, at least min_measurable_time; 0 where it is not said

  friend bool operator==(const Reading&, const Reading&) = default;
};

/// Output of a targetRunner: cost, or cost and time; before a targetEvaluator nothing, or a time
/// (irace facts, 18.2); with aclib the line of GenericWrapper4AC (18.5). `bound` is the run's, 0
/// for none. Errors: a sentence that says what was printed and what is wanted.
Expected<Reading> parse_runner_output(std::string_view output, const Target& target,
                                      double bound = 0);

/// Output of a targetEvaluator: the cost; in batch mode perhaps a time after it (18.4).
Expected<Reading> parse_evaluator_output(std::string_view output, const Target& target);

/// The job's id that a targetRunner prints in batch mode, and nothing else.
Expected<std::string> parse_job_id(std::string_view output);

/// The text as people may see it: escapes for what is not shown (base/shown_text.h), and of
/// a long text only the end stays, after "...".
std::string printable(std::string_view text, std::size_t longest);

}  // namespace swarmsmith
