#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <string_view>

#include "coordinator/cli/assessment_text.h"
#include "coordinator/cli/commands.h"
#include "coordinator/cli/world_argument.h"

namespace swarmsmith::cli {
namespace {

using assessment::Report;

struct Arguments {
  std::string flavour = "watermelon";
  std::string profile = "rvr";
};

/// Counts the modules on the error stream, once it has taken longer than people like to wait: on a
/// terminal in one line that goes away again, elsewhere a line now and then.
class Counter {
 public:
  explicit Counter(Output& output) : output_(&output) {}

  void tell(int done, int of) {
    const auto now = std::chrono::steady_clock::now();
    if (output_->quiet || now < next_) return;
    const std::string text = fmt::format("assessed {} of {} modules", done, of);
    if (output_->err_is_terminal) {
      output_->err << kClearLine << (done < of ? text : std::string()) << std::flush;
    } else {
      next_ = now + std::chrono::seconds(30);
      output_->err << text << '\n' << std::flush;
    }
  }

 private:
  static constexpr std::string_view kClearLine = "\r\x1b[2K";

  Output* output_;
  std::chrono::steady_clock::time_point next_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(2);
};

ExitCode run(const Arguments& arguments, Output& output) {
  const auto flavour = find_flavour(arguments.flavour);
  if (!flavour) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::BadInput, flavour.error().message, "--flavour"});
  }
  const auto profile = find_profile_or_complain(arguments.profile, "--profile", output);
  if (!profile) return fail(output, ExitCode::Usage, profile.error());
  Counter counter(output);
  const Report report = assessment::assess(
      **flavour, *profile, [&counter](int done, int of) { counter.tell(done, of); });
  output.out << (output.json ? assessment_json(report, (*flavour)->name, profile->name)
                             : assessment_text(report, (*flavour)->name, profile->name));
  return report.passes() && output.out.good() ? ExitCode::Done : ExitCode::Failed;
}

}  // namespace

Run declare_assess(Options& options) {
  auto arguments = std::make_shared<Arguments>();
  options.text("--flavour", arguments->flavour,
               "Flavour whose modules are assessed (default watermelon)");
  options.text("--profile", arguments->profile, "Simulator profile (default rvr)");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith::cli
