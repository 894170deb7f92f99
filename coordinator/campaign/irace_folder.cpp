#include "coordinator/campaign/irace_folder.h"

#include <algorithm>
#include <variant>

#include "coordinator/campaign/campaign_text.h"
#include "coordinator/campaign/internal/irace_texts.h"
#include "coordinator/campaign/machine_space.h"

namespace swarmsmith {
namespace {

/// In single quotes for a shell.
std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text)
    quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

/// irace's calling convention (irace facts, 18.1); a POSIX shell needs no other program for it.
std::string target_runner(const DesignRow& design, const std::filesystem::path& program) {
  return "#!/bin/sh\n"
         "# One experiment of irace: simulates a machine once and prints its cost, minus the "
         "score.\n"
         "# irace calls: target-runner CONFIGURATION INSTANCE-NUMBER SEED INSTANCE MACHINE...\n"
         "# SWARMSMITH names another program.\n"
         "program=" +
         shell_quoted(program.string()) +
         "\n"
         "seed=$3\n"
         "shift 4\n"
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

std::string readme(const Campaign& campaign, const DesignRow& design, IraceVersion version) {
  const std::string name = version == IraceVersion::V4 ? "4" : "3.5";
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
         "started in this folder. --parallel N runs N simulations at a time, --seed S draws\n"
         "others.\n"
         "\n"
         "parameters.txt  the machines of the method; switches and values are AutoMoDe's text\n"
         "scenario.txt    the options of the race\n"
         "instances.txt   the mission: each run has a new seed\n"
         "target-runner   simulates one machine once with `swarmsmith evaluate`; prints minus\n"
         "                the score\n"
         "campaign.toml   what the target-runner reads: mission, flavour, simulator profile\n"
         "\n"
         "The last line of irace's report, from --nstates on, is the machine that was found:\n"
         "\n"
         "    swarmsmith evaluate --campaign campaign.toml --design " +
         to_string(design.id) + " --seeds 1-200 -- --nstates ...\n";
}

/// Why irace cannot do what the campaign asks for.
Expected<void> check_expressible(const Campaign& campaign, IraceVersion version) {
  if (campaign.target) {
    return bad_input(
        "the campaign's target is not the simulator: its own scenario is what irace reads",
        "[simulator]");
  }
  if (campaign.race.max_time > 0) {
    return bad_input("a simulation prints no time, which max_time needs", "max_time");
  }
  if (version == IraceVersion::V3_5 && campaign.race.block_size > 1) {
    return bad_input("irace 3.5 has no blocks; export for --irace 4", "block_size");
  }
  return {};
}

}  // namespace

Expected<std::vector<NamedText>> irace_folder(const Campaign& campaign, const DesignRow& design,
                                              IraceVersion version,
                                              const std::filesystem::path& program) {
  if (auto possible = check_expressible(campaign, version); !possible) {
    return Unexpected(possible.error());
  }
  const auto method = std::ranges::find(campaign.methods, design.method, &Method::name);
  const auto mission = std::ranges::find_if(
      campaign.missions,
      [&](const CampaignMission& candidate) { return candidate.mission.name == design.mission; });
  const auto flavour = find_flavour(method->flavour);
  if (!flavour) return Unexpected(flavour.error());
  const int digits = static_cast<int>(campaign.digits);
  const auto space = MachineSpace::in_grammar(*method, **flavour, digits);
  if (!space) return Unexpected(space.error());

  Scenario race = campaign.race;
  race.max_experiments = design.budget;
  std::vector<NamedText> files;
  files.push_back({"README", readme(campaign, design, version)});
  files.push_back({"campaign.toml", normalised_text(campaign)});
  files.push_back({"instances.txt", mission->mission.name + "\n"});
  std::string tests;
  for (std::int64_t i = 0; i < mission->test_count; ++i)
    tests += mission->mission.name + "\n";
  if (!tests.empty()) files.push_back({"test-instances.txt", tests});
  files.push_back({"parameters.txt", irace_parameters(*space, version)});
  files.push_back({"scenario.txt", irace_scenario(race, digits, !tests.empty(), version)});
  files.push_back({"target-runner", target_runner(design, program), true});
  return files;
}

}  // namespace swarmsmith
