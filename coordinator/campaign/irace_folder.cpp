#include "coordinator/campaign/irace_folder.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "coordinator/campaign/campaign_text.h"
#include "coordinator/campaign/method_space.h"
#include "coordinator/campaign/network_space.h"
#include "irace_core/files/instances_file.h"
#include "irace_core/files/parameter_file.h"

namespace swarmsmith {
namespace {

/// Puts a text in single quotes for a shell.
std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text)
    quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

/// The beginning of a network's text; its weights follow as irace's values, without switches.
std::string words_before_weights(const Method& method) {
  return "--network " + std::string(name_of(method.inputs)) + " --weights";
}

/// Follows irace's calling convention (irace facts, 18.1); it needs only a POSIX shell.
std::string target_runner(const Method& method, const DesignRow& design,
                          const std::filesystem::path& program) {
  const std::string kind(name_of(method.architecture));
  const bool is_network = method.architecture == Architecture::Network;
  return "#!/bin/sh\n"
         "# One experiment of irace: simulates a " +
         kind +
         " once and prints its cost, minus the "
         "score.\n"
         "# irace calls: target-runner CONFIGURATION INSTANCE-NUMBER SEED INSTANCE VALUES...\n"
         "# SWARMSMITH names another program.\n"
         "program=" +
         shell_quoted(program.string()) +
         "\n"
         "seed=$3\n"
         "shift 4\n" +
         (is_network
              ? "set -- " + words_before_weights(method) + " \"$(IFS=,; printf %s \"$*\")\"\n"
              : "") +
         "answer=$(\"${SWARMSMITH:-$program}\" evaluate --json --campaign "
         "\"${0%/*}/campaign.toml\" \\\n"
         "  --design " +
         to_string(design.id) +
         " --seeds \"$seed\" -- \"$@\") || exit\n"
         "score=${answer##*:}\n"
         "score=${score%\\}}\n"
         "case $score in\n"
         "  -*) echo \"${score#-}\" ;;\n"
         "  0) echo 0 ;;\n"
         "  *) echo \"-$score\" ;;\n"
         "esac\n";
}

/// How to find the control software in the last line of irace's report.
std::string reported(const Method& method) {
  switch (method.architecture) {
    case Architecture::Machine:
      return "from --nstates on, is the machine that was found";
    case Architecture::Tree:
      return "from --nroot on, is the tree that was found";
    case Architecture::Network:
      break;
  }
  return "after its number, is the weights that were found; commas\nbelong between them";
}

std::string found_text(const Method& method) {
  switch (method.architecture) {
    case Architecture::Machine:
      return "--nstates ...";
    case Architecture::Tree:
      return "--nroot ...";
    case Architecture::Network:
      break;
  }
  return words_before_weights(method) + " W1,W2,...";
}

std::string readme(const Campaign& campaign, const Method& method, const DesignRow& design,
                   IraceVersion version) {
  const std::string name = version == IraceVersion::V4 ? "4" : "3.5";
  const std::string kind(name_of(method.architecture));
  const std::string parameters =
      method.architecture == Architecture::Network
          ? "the weights of the method's networks, left wheel first"
          : "the " + kind + "s of the method; switches and values are AutoMoDe's text";
  return "Design " + to_string(design.id) + " of campaign " + campaign.name + ": mission " +
         design.mission + ", method " + design.method +
         ",\n"
         "for irace " +
         name +
         " of R.\n"
         "\n"
         "    irace --scenario scenario.txt            (R's)\n"
         "    swarmsmith irace --scenario scenario.txt (the same files, without R)\n"
         "\n"
         "Run one of them in this folder. --parallel N runs N simulations at a time, --seed S\n"
         "changes the seed.\n"
         "\n"
         "parameters.txt  " +
         parameters +
         "\n"
         "scenario.txt    the options of the race\n"
         "instances.txt   the mission: each run has a new seed\n"
         "target-runner   simulates one " +
         kind +
         " once with `swarmsmith evaluate`; prints minus\n"
         "                the score\n"
         "campaign.toml   what the target-runner reads: mission, flavour, simulator profile\n"
         "\n"
         "The last line of irace's report, " +
         reported(method) +
         ":\n"
         "\n"
         "    swarmsmith evaluate --campaign campaign.toml --design " +
         to_string(design.id) + " --seeds 1-200 -- " + found_text(method) + "\n";
}

/// The method's space, in which the switches and values of a configuration form its text. For
/// networks the space has only the weights, and the target-runner makes the text from them.
Expected<ParameterSpace> space_in_grammar(const Method& method, const Flavour& flavour,
                                          int digits) {
  switch (method.architecture) {
    case Architecture::Machine:
      return MachineSpace::in_grammar(method, flavour, digits);
    case Architecture::Tree:
      return TreeSpace::in_grammar(method, flavour, digits);
    case Architecture::Network:
      break;
  }
  auto space = network_space(method, digits);
  if (!space) return space;
  std::vector<Parameter> weights(space->parameters().begin(), space->parameters().end());
  for (Parameter& weight : weights)
    weight.switch_text.clear();
  return ParameterSpace::make(std::move(weights), {}, digits);
}

/// The irace setup for a design of control software: one instance (the mission), whose runs differ
/// in their seeds, and as many test instances as there are seeds for the winner's tests.
Expected<IraceSetup> setup_of_simulations(const Campaign& campaign, const Method& method,
                                          const CampaignMission& mission) {
  if (campaign.race.max_time > 0) {
    return bad_input("a simulation prints no time, which max_time needs", "max_time");
  }
  const auto flavour = find_flavour(method.flavour, method.turn_clock, method.own_flavour);
  if (!flavour) return Unexpected(flavour.error());
  auto space = space_in_grammar(method, *flavour, static_cast<int>(campaign.digits));
  if (!space) return Unexpected(space.error());
  IraceSetup setup;
  setup.space = std::move(*space);
  setup.target_runner = "./target-runner";
  setup.training = {mission.mission.name};
  setup.test.assign(static_cast<std::size_t>(mission.test_count), mission.mission.name);
  return setup;
}

/// The value of irace's option batchmode.
std::string_view word_of(BatchMode mode) {
  constexpr std::array<std::string_view, 6> kWords = {"0",      "sge",   "pbs",
                                                      "torque", "slurm", "htcondor"};
  return kWords.at(static_cast<std::size_t>(mode));
}

/// The reverse of `campaign_of`: the irace setup of a design that programs evaluate.
Expected<IraceSetup> setup_of_target(const Campaign& campaign, const Method& method,
                                     const CampaignMission& mission) {
  const auto space = MethodSpace::make(method, static_cast<int>(campaign.digits));
  if (!space) return Unexpected(space.error());
  const Target& target = *campaign.target;
  IraceSetup setup;
  setup.space = space->parameters();
  setup.training = mission.instances.training;
  setup.test = mission.instances.test;
  setup.exec_dir = target.folder;
  setup.target_runner = target.runner;
  setup.target_runner_launcher = target.launcher;
  setup.target_cmdline = target.command_line;
  setup.target_evaluator = target.evaluator;
  setup.target_runner_retries = target.retries;
  setup.target_runner_timeout = target.timeout_s;
  setup.aclib = target.aclib;
  setup.batchmode = word_of(target.batch_mode);
  setup.debug_level = target.debug_level;
  return setup;
}

/// Adds all files except the parameter file. Errors: an instance that the file cannot have.
Expected<void> add_files(const IraceSetup& setup, IraceVersion version, IraceFileNames names,
                         IraceFolder& folder) {
  auto training = print_instances(setup.training);
  if (!training) return Unexpected(training.error());
  folder.files.push_back({names.training, std::move(*training)});
  if (!setup.test.empty()) {
    names.test = "test-instances.txt";
    auto test = print_instances(setup.test);
    if (!test) return Unexpected(test.error());
    folder.files.push_back({names.test, std::move(*test)});
  }
  const IraceScenarioText scenario = print_irace_scenario(setup, version, names);
  folder.files.push_back({"scenario.txt", scenario.text});
  folder.remarks = scenario.remarks;
  return {};
}

/// Adds the parameter file; returns the names of the files that belong to it.
Expected<IraceFileNames> add_parameters(const ParameterSpace& space, IraceVersion version,
                                        IraceFolder& folder) {
  IraceFileNames names;
  names.training = "instances.txt";
  if (version == IraceVersion::V4) {
    auto text = print_parameter_file(space);
    if (!text) return Unexpected(text.error());
    folder.files.push_back({names.parameters, std::move(*text)});
    return names;
  }
  auto files = print_irace_35_files(space);
  if (!files) return Unexpected(files.error());
  folder.files.push_back({names.parameters, std::move(files->parameters)});
  if (files->forbidden.empty()) return names;
  names.forbidden = "forbidden.txt";
  folder.files.push_back({names.forbidden, std::move(files->forbidden)});
  return names;
}

}  // namespace

Expected<IraceSetup> irace_setup(const Campaign& campaign, const DesignRow& design) {
  const Method& method = *std::ranges::find(campaign.methods, design.method, &Method::name);
  if (!method.baseline.empty()) {
    return bad_input("it is of the baseline " + method.name +
                         ", which is not searched for: irace would have nothing to race",
                     to_string(design.id));
  }
  const CampaignMission& mission = *std::ranges::find_if(
      campaign.missions,
      [&](const CampaignMission& candidate) { return candidate.mission.name == design.mission; });
  auto setup = campaign.target ? setup_of_target(campaign, method, mission)
                               : setup_of_simulations(campaign, method, mission);
  if (!setup) return setup;
  setup->race = campaign.race;
  setup->race.max_experiments = design.budget;
  setup->race.min_experiments.reset();
  setup->repair_configuration = campaign.repair;
  setup->test_nb_elites = campaign.test_nb_elites;
  setup->test_iteration_elites = campaign.test_iteration_elites;
  setup->log_file = "./irace.Rdata";
  return setup;
}

Expected<IraceFolder> irace_folder(const Campaign& campaign, const DesignRow& design,
                                   IraceVersion version, const std::filesystem::path& program) {
  auto setup = irace_setup(campaign, design);
  if (!setup) return Unexpected(setup.error());
  const Method& method = *std::ranges::find(campaign.methods, design.method, &Method::name);
  IraceFolder folder;
  auto names = add_parameters(setup->space, version, folder);
  if (!names) return Unexpected(names.error());
  if (!method.configurations.empty()) {
    names->configurations = "configurations.txt";
    folder.files.push_back({names->configurations, method.configurations});
  }
  if (auto added = add_files(*setup, version, *names, folder); !added)
    return Unexpected(added.error());
  if (campaign.target) return folder;
  folder.files.push_back({"README", readme(campaign, method, design, version)});
  folder.files.push_back({"campaign.toml", normalised_text(campaign)});
  folder.files.push_back({"target-runner", target_runner(method, design, program), true});
  return folder;
}

}  // namespace swarmsmith
