#include "proto/scenario/target_message.h"

#include <cmath>
#include <cstddef>
#include <string>

#include "proto/scenario.pb.h"

namespace swarmsmith {
namespace {

/// Linux's limit for one word of a command line.
constexpr std::size_t kLongestText = 128U << 10U;
constexpr std::int64_t kMostRetries = 1'000'000;
constexpr std::int64_t kLongestTimeout =
    std::int64_t{10} * 365 * 86'400;  // s; ten years, which is as good as no limit

static_assert(static_cast<int>(BatchMode::None) == pb::Target::BATCH_MODE_NONE &&
                  static_cast<int>(BatchMode::Sge) == pb::Target::BATCH_MODE_SGE &&
                  static_cast<int>(BatchMode::Pbs) == pb::Target::BATCH_MODE_PBS &&
                  static_cast<int>(BatchMode::Torque) == pb::Target::BATCH_MODE_TORQUE &&
                  static_cast<int>(BatchMode::Slurm) == pb::Target::BATCH_MODE_SLURM &&
                  static_cast<int>(BatchMode::HtCondor) == pb::Target::BATCH_MODE_HTCONDOR,
              "batch systems have one number each");

bool is_text(const std::string& text) {
  return text.size() <= kLongestText && text.find('\0') == std::string::npos;
}

bool is_path(const std::string& text) {
  return is_text(text) && text.starts_with('/');
}

bool is_path_or_empty(const std::string& text) {
  return text.empty() || is_path(text);
}

}  // namespace

void to_message(const Target& target, pb::Target& out) {
  out.set_runner(target.runner);
  out.set_launcher(target.launcher);
  out.set_command_line(target.command_line);
  out.set_evaluator(target.evaluator);
  out.set_folder(target.folder);
  out.set_retries(target.retries);
  out.set_timeout_s(target.timeout_s);
  out.set_timeout_is_rejection(target.timeout_is_rejection);
  out.set_aclib(target.aclib);
  out.set_batch_mode(static_cast<pb::Target::BatchMode>(target.batch_mode));
  out.set_prints_time(target.prints_time);
  out.set_min_measurable_time(target.min_measurable_time);
  out.set_debug_level(target.debug_level);
}

void to_message(const InstanceTexts& instances, pb::InstanceTexts& out) {
  for (const std::string& text : instances.training)
    out.add_training(text);
  for (const std::string& text : instances.test)
    out.add_test(text);
}

Expected<Target> from_message(const pb::Target& message) {
  if (!is_path(message.runner())) return bad_input("not an absolute path", "runner");
  if (!is_path_or_empty(message.launcher())) return bad_input("not an absolute path", "launcher");
  if (!is_path_or_empty(message.evaluator())) return bad_input("not an absolute path", "evaluator");
  if (!is_path(message.folder())) return bad_input("not an absolute path", "folder");
  if (!is_text(message.command_line())) {
    return bad_input("too long, or with a NUL byte", "command_line");
  }
  if (message.retries() < 0 || message.retries() > kMostRetries) {
    return bad_input("a number outside of its limits", "retries");
  }
  if (message.timeout_s() < 0 || message.timeout_s() > kLongestTimeout) {
    return bad_input("a number outside of its limits", "timeout_s");
  }
  if (!std::isfinite(message.min_measurable_time()) || message.min_measurable_time() < 0) {
    return bad_input("a number outside of its limits", "min_measurable_time");
  }
  if (message.debug_level() < 0 || message.debug_level() > 3) {
    return bad_input("a number outside of its limits", "debug_level");
  }
  if (!pb::Target::BatchMode_IsValid(message.batch_mode())) {
    return bad_input("a batch system that this program does not know", "batch_mode");
  }
  const auto batch_mode = static_cast<BatchMode>(message.batch_mode());
  if (batch_mode != BatchMode::None && message.evaluator().empty()) {
    return bad_input("batch mode needs a targetEvaluator, which prints the costs", "evaluator");
  }
  return Target{.runner = message.runner(),
                .launcher = message.launcher(),
                .command_line = message.command_line(),
                .evaluator = message.evaluator(),
                .folder = message.folder(),
                .retries = message.retries(),
                .timeout_s = message.timeout_s(),
                .timeout_is_rejection = message.timeout_is_rejection(),
                .aclib = message.aclib(),
                .batch_mode = batch_mode,
                .prints_time = message.prints_time(),
                .min_measurable_time = message.min_measurable_time(),
                .debug_level = static_cast<int>(message.debug_level())};
}

Expected<InstanceTexts> from_message(const pb::InstanceTexts& message) {
  InstanceTexts instances;
  for (const std::string& text : message.training())
    instances.training.push_back(text);
  for (const std::string& text : message.test())
    instances.test.push_back(text);
  for (const auto* texts : {&instances.training, &instances.test}) {
    for (const std::string& text : *texts) {
      if (!is_text(text)) return bad_input("an instance that is too long, or has a NUL byte");
    }
  }
  return instances;
}

}  // namespace swarmsmith
