#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "coordinator/cli/assessment_text.h"
#include "coordinator/cli/commands.h"

namespace swarmsmith::cli {
namespace {

using assessment::Report;

struct Arguments {
  std::string flavour = "watermelon";
  std::string profile = "rvr";
};

/// Counts the modules on the error stream, once it has taken longer than people like to wait.
class Counter {
 public:
  explicit Counter(Output& output) : output_(&output) {}

  void tell(int done, int of) {
    constexpr auto kPatience = std::chrono::seconds(2);
    if (output_->quiet || std::chrono::steady_clock::now() - begin_ < kPatience) return;
    // Only a terminal can take a line back.
    output_->err << (output_->err_is_terminal ? "\r\x1b[2K" : "")
                 << fmt::format("assessed {} of {} modules", done, of)
                 << (output_->err_is_terminal && done < of ? "" : "\n") << std::flush;
  }

 private:
  Output* output_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

ExitCode run(const Arguments& arguments, Output& output) {
  const auto flavour = find_flavour(arguments.flavour);
  if (!flavour) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::BadInput, flavour.error().message, "--flavour"});
  }
  const auto profile = built_in_profile(arguments.profile);
  if (!profile) {
    return fail(output, ExitCode::Usage,
                {ErrorKind::BadInput, profile.error().message, "--profile"});
  }
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
