#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "programs/target.h"

namespace swarmsmith {

/// What one call of a targetRunner is about.
struct RunnerCall {
  std::int64_t configuration = 0;
  std::string instance_id;  ///< number of the user's instance: "3", in testing "3t"
  std::int64_t seed = 0;
  std::string instance;
  double bound = 0;      ///< most time of the run; 0 for none
  std::string switches;  ///< switches and values of the active parameters
};

/// What one call of a targetEvaluator is about.
struct EvaluatorCall {
  std::int64_t configuration = 0;
  std::string instance_id;
  std::int64_t seed = 0;
  std::string instance;
  std::vector<std::int64_t> alive;  ///< configurations
};

/// What is missing in a template of command lines, a sentence each: {seed}, {instance} and
/// {targetRunnerArgs} must occur, and {bound} when runs are bounded (irace facts, 18.1).
std::vector<std::string> faults_of_command_line(std::string_view command_line, bool capping);

/// The text after the program's name, for a shell or `split_words`. Names in braces are replaced
/// once: what comes in is not looked at again; unknown ones stay. Blanks stay as they are in the
/// template, so that an empty bound leaves two (irace facts, 18.1). With a launcher the runner's
/// path, quoted, comes first, unless the template has its place. With aclib it is
/// GenericWrapper4AC's form (18.5).
std::string arguments_of(const Target& target, const RunnerCall& call);

/// id instanceID seed instance numAlive id1 id2 ... (irace facts, 18.4).
std::string arguments_of(const EvaluatorCall& call);

/// At most 15 significant digits, never an exponent, no zeros at the end (irace facts, 18.1).
std::string plain_number(double value);

}  // namespace swarmsmith
