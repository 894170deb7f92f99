#include <fmt/format.h>

#include "tests/fuzz/fuzz.h"
#include "tracking/video/frame_clock.h"

namespace swarmsmith::fuzz {

/// Frame times are refused with a line and a reason, or grow, and read back as the same.
void run(std::string_view input) {
  const auto times = parse_frame_times(input);
  if (!times) {
    require(times.error().where.starts_with("line "), "an error has a line");
    return require(!times.error().message.empty(), "an error has a sentence");
  }
  require(!times->empty(), "there is a frame");
  std::string text = "frame,time_s\n";
  for (std::size_t i = 0; i < times->size(); ++i) {
    require(i == 0 || (*times)[i] > (*times)[i - 1], "times grow");
    text += fmt::format("{},{}\n", i, (*times)[i]);
  }
  const auto again = parse_frame_times(text);
  require(again && *again == *times, "what is printed reads back as the same");
}

}  // namespace swarmsmith::fuzz
