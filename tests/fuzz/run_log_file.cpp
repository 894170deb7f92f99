#include "tests/fuzz/fuzz.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith::fuzz {

/// Run logs in a folder that is not there: refused with reasons, places and codes, or read to a log
/// whose text reads back as the same.
void run(std::string_view input) {
  const auto log = parse_run_log(input, "/no-such-folder/run.toml");
  if (!log) return require_reasons(log.error(), "E_");
  const auto again = parse_run_log(run_log_text(*log), "/no-such-folder/again.toml");
  require(again.has_value(), "what is printed can be read");
  require(*again == *log, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
