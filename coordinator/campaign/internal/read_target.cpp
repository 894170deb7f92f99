#include "coordinator/campaign/internal/read_target.h"

#include <algorithm>
#include <cmath>

#include "base/environment.h"
#include "base/program_path.h"
#include "base/text/whole_file.h"
#include "irace_core/files/instances_file.h"
#include "sim/files/mission_file.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

/// The numbers of test pairs must stay within the range that a store can name.
constexpr std::int64_t kMostInstances = 99'999;

fs::path absolute_in(const fs::path& folder, const fs::path& path) {
  fs::path whole = (fs::current_path() / folder / path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/// Reads the runner's path; the words before and after it on a command line have their own keys.
std::string read_runner(TableReader& simulator, const fs::path& folder) {
  const auto words = simulator.texts("command");
  if (!words) {
    if (!simulator.has("command")) {
      simulator.complain("command",
                         "kind = \"command\" needs `command`, the program that evaluates, such as "
                         "[\"./target-runner\"]");
    }
    return {};
  }
  if (words->size() != 1 || words->front().empty()) {
    simulator.complain("command",
                       "`command` must name one program; an interpreter before it goes into "
                       "`launcher`, and what follows it into `command_line`");
    return {};
  }
  return program_path(words->front(), folder);
}

/// The path of a program under an optional key; empty without the key.
std::string read_program(TableReader& table, std::string_view key, const fs::path& folder) {
  const auto name = table.text(key);
  return name && !name->empty() ? program_path(*name, folder) : "";
}

/// Reads the instances from a list, or from a file with one instance per line; returns `none`
/// without either.
std::vector<std::string> read_instances(TableReader& table, std::string_view key,
                                        const fs::path& folder, std::vector<std::string> none) {
  const std::string file_key = std::string(key) + "_file";
  if (table.has(key) && table.has(file_key)) {
    table.complain(file_key, "give `" + std::string(key) + "` or `" + file_key + "`, not both");
  }
  std::optional<std::vector<std::string>> instances;
  if (table.has(key)) instances = table.texts(key);
  if (const auto name = table.text(file_key)) {
    const auto text = read_file(folder / *name, "instances");
    if (!text) {
      table.complain_foreign(file_key, text.error());
    } else {
      instances = parse_instances(*text);
    }
  }
  if (!instances) return none;
  const std::string_view used = table.has(key) ? key : std::string_view(file_key);
  if (instances->empty()) table.complain(used, "`" + std::string(used) + "` has no instance");
  if (static_cast<std::int64_t>(instances->size()) > kMostInstances) {
    table.complain(used, "at most " + std::to_string(kMostInstances) + " instances are allowed");
  }
  return std::move(*instances);
}

/// `test` is a list of instances, or `{ count = 20 }`: new seeds on the training instances.
void read_tests(TableReader& instances, const fs::path& folder, CampaignMission& mission) {
  const auto is_table = [&] {
    const Node* node = instances.take("test");
    return node != nullptr && std::holds_alternative<Table>(node->value);
  };
  if (instances.has("test") && is_table()) {
    auto test = instances.table("test");
    mission.test_count = test->integer("count", {0, kMostInstances}).value_or(0);
    test->finish();
    return;
  }
  mission.instances.test = read_instances(instances, "test", folder, {});
  mission.test_count = static_cast<std::int64_t>(mission.instances.test.size());
}

}  // namespace

std::string program_path(const std::string& name, const fs::path& folder) {
  fs::path here = absolute_in(folder, name);
  if (name.find('/') != std::string::npos || may_be_run(here)) return here.string();
  return program_in(environment("PATH"), name).value_or(here).string();
}

Target read_target(TableReader& simulator, const fs::path& folder) {
  static const std::vector<std::string> kBatchModes = {"none",   "sge",   "pbs",
                                                       "torque", "slurm", "htcondor"};
  static const std::vector<std::string> kOnTimeout = {"fail", "reject"};
  Target target;
  target.runner = read_runner(simulator, folder);
  target.launcher = read_program(simulator, "launcher", folder);
  target.command_line = simulator.text("command_line").value_or(target.command_line);
  target.evaluator = read_program(simulator, "evaluator", folder);
  target.folder = absolute_in(folder, simulator.text("folder").value_or("")).string();
  target.retries = simulator.integer("retries", {0, 1000}).value_or(0);
  const double timeout_s = simulator.seconds("timeout", {0, 1e9}).value_or(0);
  target.timeout_s = static_cast<std::int64_t>(std::ceil(timeout_s));
  target.timeout_is_rejection = simulator.choice("on_timeout", kOnTimeout) == "reject";
  target.aclib = simulator.boolean("aclib").value_or(false);
  if (const auto mode = simulator.choice("batch_mode", kBatchModes)) {
    const auto place = std::ranges::find(kBatchModes, *mode) - kBatchModes.begin();
    target.batch_mode = static_cast<BatchMode>(place);
  }
  if (target.batch_mode != BatchMode::None && target.evaluator.empty()) {
    simulator.complain(
        "batch_mode",
        "`batch_mode` needs an `evaluator`: the runner prints only the ids of its jobs");
  }
  return target;
}

std::vector<CampaignMission> read_target_missions(TableReader& root, const fs::path& folder) {
  std::vector<CampaignMission> missions;
  std::vector<std::string> names;
  for (TableReader& table : root.tables("mission")) {
    CampaignMission& mission = missions.emplace_back();
    mission.mission.name = table.text("name").value_or("");
    check_name(table, mission.mission.name, names);
    names.push_back(mission.mission.name);
    mission.test_count = 0;
    mission.instances.training = {mission.mission.name};
    if (auto instances = table.table("instances")) {
      mission.instances.training =
          read_instances(*instances, "training", folder, mission.instances.training);
      read_tests(*instances, folder, mission);
      instances->finish();
    }
    table.finish();
  }
  if (!root.has("mission")) {
    root.complain("mission",
                  "the file has no [[mission]]; with kind = \"command\" the shortest is "
                  "[[mission]] with name = \"tuning\"");
  }
  return missions;
}

}  // namespace swarmsmith
