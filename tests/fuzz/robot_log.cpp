#include "robot/log/log_text.h"

#include "robot/runtime/replay.h"
#include "tests/fuzz/fuzz.h"

namespace swarmsmith::fuzz {
namespace {

void read_rows(std::string_view input) {
  auto rows = parse_log_rows(input, "run07.rvr1.log.csv");
  if (!rows) return require_reasons(rows.error());
  std::string text = log_columns();
  for (const LogRow& row : *rows)
    text += log_line(row);
  const auto again = parse_log_rows(text, "again.log.csv");
  require(again.has_value(), "what is printed can be read");
  std::string same = log_columns();
  for (const LogRow& row : *again)
    same += log_line(row);
  require(same == text, "what is printed reads back as the same");
  const LogHead head{.machine =
                         "--nstates 2 --s0 0 --rwm0 10 --n0 1 --n0x0 0 --c0x0 0 --p0x0 0.8 "
                         "--s1 2 --att1 2 --n1 1 --n1x0 0 --c1x0 3 --p1x0 1 --w1x0 2",
                     .flavour = "watermelon",
                     .turn_clock = "seconds",
                     .max_mps = 0.35};
  RunRecord record{head, std::move(*rows)};
  static_cast<void>(replay_log(record));
}

void read_head(std::string_view input) {
  const auto head = parse_log_head(input, "run07.rvr1.toml");
  if (!head) return require_reasons(head.error());
  const auto again = parse_log_head(log_head_text(*head), "again.toml");
  require(again.has_value(), "what is printed can be read");
  require(*again == *head, "what is printed reads back as the same");
}

}  // namespace

/// Both files of a robot's log: refused with reasons and places, or read to what prints and reads
/// back as the same. Whatever readings are in rows, a controller can be stepped through them.
void run(std::string_view input) {
  read_rows(input);
  read_head(input);
}

}  // namespace swarmsmith::fuzz
