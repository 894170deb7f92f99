#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "programs/target.h"

namespace swarmsmith {

/// The arguments of one call of a targetRunner.
struct RunnerCall {
  std::int64_t configuration = 0;
  std::string instance_id;  ///< number of the instance in the user's list: "3", in testing "3t"
  std::int64_t seed = 0;
  std::string instance;
  double bound = 0;      ///< maximum time of the run; 0: no limit
  std::string switches;  ///< switches and values of the active parameters
};

/// The arguments of one call of a targetEvaluator.
struct EvaluatorCall {
  std::int64_t configuration = 0;
  std::string instance_id;
  std::int64_t seed = 0;
  std::string instance;
  std::vector<std::int64_t> alive;  ///< alive configurations
};

/// The errors in a template of command lines, one sentence each: {seed}, {instance} and
/// {targetRunnerArgs} must occur, and {bound} if runs are bounded (irace facts, 18.1).
std::vector<std::string> faults_of_command_line(std::string_view command_line, bool capping);

/// The text after the program's name, for a shell or `split_words`. Each name in braces is replaced
/// once, and replacements are not expanded again; unknown names stay. Blanks of the template stay,
/// so that an empty bound leaves two (irace facts, 18.1). With a launcher, the runner's path comes
/// first, quoted, unless the template has a place for it. With aclib, the text has the form of
/// GenericWrapper4AC (18.5).
std::string arguments_of(const Target& target, const RunnerCall& call);

/// id instanceID seed instance numAlive id1 id2 ... (irace facts, 18.4).
std::string arguments_of(const EvaluatorCall& call);

/// At most 15 significant digits, never an exponent, no zeros at the end (irace facts, 18.1).
std::string plain_number(double value);

}  // namespace swarmsmith
