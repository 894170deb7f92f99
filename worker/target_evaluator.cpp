#include "worker/target_evaluator.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/assert.h"
#include "base/hash.h"
#include "programs/cost.h"
#include "programs/runner.h"

namespace swarmsmith {
namespace {

/// A signal that kills a program from outside often ends the worker too, a moment later: then the
/// evaluation did not fail, and goes to another worker.
constexpr int kOutsideGraceMs = 100;

std::optional<std::string> canonical(const std::string& path) {
  std::error_code failed;
  const auto resolved = std::filesystem::canonical(path, failed);
  if (failed) return std::nullopt;
  return resolved.string();
}

std::uint64_t digest_of(const Reading& reading) {
  Digest digest;
  digest.add(reading.cost + 0.0);  // -0 counts as 0
  digest.add(reading.time);
  return digest.value64();
}

/// The file of a program, if it is currently on the list: a path without links. The list trusts
/// everyone who can change that file.
Expected<std::string> allowed_file(const std::string& program,
                                   const std::vector<std::string>& allowed) {
  std::optional<std::string> file = canonical(program);
  if (!file) {
    return unexpected(ErrorKind::NotFound, "there is no such program on this host", program);
  }
  if (std::ranges::find(allowed, *file) != allowed.end()) return std::move(*file);
  return unexpected(ErrorKind::Conflict, "the campaign needs the program " + *file +
                                             ", which this worker may not run: start the worker "
                                             "with --allow " +
                                             *file);
}

/// An instance as passed to programs.
struct NamedInstance {
  std::string id;
  std::string text;
};

class Programs {
 public:
  Programs(std::shared_ptr<const WorkerScenario> scenario, const AllowedPrograms& allowed,
           std::shared_ptr<const Interrupt> interrupt)
      : scenario_(std::move(scenario)),
        target_(*scenario_->target),
        allowed_(allowed.programs),
        interrupt_(std::move(interrupt)),
        runner_(target_,
                {.file_of = [list = allowed.programs](
                                const std::string& program) { return allowed_file(program, list); },
                 .shell = allowed.shell,
                 .batch_poll = allowed.batch_poll},
                *interrupt_) {}

  /// Refuses a campaign that cannot run here before any of its programs is run.
  Expected<void> check_all() const {
    for (const auto& [role, program] : {std::pair{"targetRunner", &target_.runner},
                                        {"targetRunnerLauncher", &target_.launcher},
                                        {"targetEvaluator", &target_.evaluator}}) {
      if (program->empty()) continue;
      if (const auto file = allowed_file(*program, allowed_); !file) {
        return unexpected(file.error().kind, std::string(role) + ": " + file.error().message,
                          file.error().where);
      }
    }
    std::error_code failed;
    if (std::filesystem::is_directory(target_.folder, failed)) return {};
    return unexpected(ErrorKind::NotFound,
                      "this host does not have the folder in which the campaign's programs run",
                      target_.folder);
  }

  Result operator()(const LeasedTask& item) const {
    const Expected<NamedInstance> instance = instance_of(item);
    if (!instance) return {.failure = to_string(instance.error())};
    const auto result = evaluate(item, *instance);
    if (result) return result_of(*result);
    if (result.error().from_outside) interrupt_->wait_ms(kOutsideGraceMs);
    return {.failure = result.error().reason, .details = result.error().details};
  }

 private:
  static bool is_evaluator_call(const LeasedTask& item) {
    return purpose_of(item.key) == kEvaluatorPurpose;
  }

  Expected<NamedInstance> instance_of(const LeasedTask& item) const {
    if (item.mission < scenario_->instances.size()) {
      const InstanceTexts& texts = scenario_->instances[item.mission];
      // Evaluator calls have the same purpose for both lists, so the sign of the instance tells
      // them apart.
      const bool test = (purpose_of(item.key) == kTestPurpose && !texts.test.empty()) ||
                        (is_evaluator_call(item) && item.instance < 0);
      const std::int64_t number = item.instance < 0 ? -item.instance : item.instance;
      const std::vector<std::string>& list = test ? texts.test : texts.training;
      if (number >= 1 && static_cast<std::size_t>(number) <= list.size()) {
        // irace's ids of instances; a `t` marks those of the test (docs/targets.md, "How the
        // target-runner is called").
        return NamedInstance{std::to_string(number) + (test ? "t" : ""),
                             list[static_cast<std::size_t>(number - 1)]};
      }
    }
    return bad_input("a task for an instance that the scenario does not have");
  }

  tl::expected<TargetResult, TargetFailure> evaluate(const LeasedTask& item,
                                                     const NamedInstance& instance) const {
    if (is_evaluator_call(item)) {
      return runner_.evaluate({.configuration = number_of(item.key),
                               .instance_id = instance.id,
                               .seed = item.seed,
                               .instance = instance.text,
                               .alive = item.alive});
    }
    return runner_.run({.configuration = number_of(item.key),
                        .instance_id = instance.id,
                        .seed = item.seed,
                        .instance = instance.text,
                        .bound = item.bound,
                        .switches = item.machine});
  }

  static Result result_of(const TargetResult& result) {
    if (result.rejected) return {.measured = {.time = result.reading.time}, .rejected = true};
    return {.measured = {.score = to_score(result.reading.cost),
                         .state_digest = digest_of(result.reading),
                         .time = result.reading.time}};
  }

  std::shared_ptr<const WorkerScenario> scenario_;  ///< shared by all slots
  Target target_;
  std::vector<std::string> allowed_;
  std::shared_ptr<const Interrupt> interrupt_;
  TargetRunner runner_;
};

}  // namespace

Expected<std::string> allowed_program(const std::string& path) {
  if (const auto resolved = canonical(path)) return *resolved;
  return unexpected(ErrorKind::NotFound, "there is no such program", path);
}

Expected<Evaluator> make_target_evaluator(std::shared_ptr<const WorkerScenario> scenario,
                                          const AllowedPrograms& allowed,
                                          std::shared_ptr<const Interrupt> interrupt) {
  SWARMSMITH_ASSERT(interrupt != nullptr, "what runs can be ended");
  if (!scenario->target) return bad_input("a scenario without programs");
  Programs programs(std::move(scenario), allowed, std::move(interrupt));
  if (auto fine = programs.check_all(); !fine) return Unexpected(fine.error());
  return Evaluator(std::move(programs));
}

}  // namespace swarmsmith
