#include "console/counter.h"

#include <utility>

#include "console/terminal.h"

namespace swarmsmith {
Counter::Counter(Output& output, std::string verb, std::string noun)
    : output_(&output),
      verb_(std::move(verb)),
      noun_(std::move(noun)),
      next_(std::chrono::steady_clock::now() + std::chrono::seconds(2)) {}

void Counter::tell(std::int64_t done, std::int64_t of) {
  const auto now = std::chrono::steady_clock::now();
  if (output_->quiet || now < next_) return;
  const std::string of_all = of > 0 ? " of " + std::to_string(of) : "";
  const std::string text = verb_ + " " + std::to_string(done) + of_all + " " + noun_;
  if (output_->err_is_terminal) {
    output_->err << kClearLine << (done != of ? text : std::string()) << std::flush;
  } else {
    next_ = now + std::chrono::seconds(30);
    output_->err << text << '\n' << std::flush;
  }
}

}  // namespace swarmsmith
