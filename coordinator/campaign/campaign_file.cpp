#include "coordinator/campaign/campaign_file.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <string>

#include "base/plain_text.h"
#include "base/text/table_reader.h"
#include "base/text/whole_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/internal/read_method.h"
#include "coordinator/campaign/internal/read_target.h"
#include "coordinator/campaign/internal/read_workers.h"
#include "coordinator/campaign/method_space.h"
#include "irace_core/search/options.h"
#include "irace_core/search/start_search.h"
#include "sim/control/flavour.h"
#include "sim/control/toml_kind.h"
#include "sim/engine/fitting.h"
#include "sim/files/profile_file.h"

namespace swarmsmith {
namespace {

constexpr std::int64_t kLargestSeed = std::numeric_limits<std::int64_t>::max();

/// The file's name without folder and extension; characters not allowed in names are replaced.
std::string name_from(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  for (char& letter : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    if (!plain && letter != '-' && letter != '.') letter = '_';
  }
  return name.empty() ? "campaign" : name;
}

/// [campaign], with defaults from the file's own name.
void read_identity(TableReader& root, Campaign& campaign, const std::filesystem::path& file) {
  campaign.store = std::filesystem::path(file).replace_extension(".db");
  campaign.name = name_from(file);
  auto table = root.table("campaign");
  if (!table) return;
  if (const auto name = table->text("name"); name && check_name(*table, *name, {})) {
    campaign.name = *name;
  }
  if (const auto seed = table->integer("seed", {0, kLargestSeed})) {
    campaign.seed = static_cast<std::uint64_t>(*seed);
  }
  campaign.repetitions = table->integer("repetitions", {1, 100'000}).value_or(1);
  if (const auto store = table->text("store")) {
    if (store->empty()) table->complain("store", "`store` is empty");
    campaign.store = file.parent_path() / *store;
  }
  table->finish();
}

/// All missions are sent to the workers in one message, and only pictures can make it large
/// (proto/wire.h).
void check_pictures(TableReader& root, const Campaign& campaign) {
  constexpr std::size_t kMostBytes = 24U << 20U;
  std::size_t bytes = 0;
  for (const CampaignMission& mission : campaign.missions) {
    for (const Patch& patch : mission.mission.arena.patches) {
      const auto* image = std::get_if<FloorImage>(&patch.shape);
      if (image != nullptr) bytes += image->picture->png().size();
    }
  }
  if (bytes <= kMostBytes) return;
  root.complain("mission",
                "the images of all missions have " + std::to_string(bytes >> 20U) +
                    " MB; at most 24 MB are allowed: make them smaller, or make two campaigns");
}

/// A profile given by name or in a separate file; none after a complaint.
std::optional<Profile> named_profile(TableReader& table, std::string_view key,
                                     const std::string& word, const std::filesystem::path& folder) {
  auto profile = find_profile(word, folder);
  if (profile) return std::move(*profile);
  for (const Error& error : profile.error()) {
    if (error.where.empty()) {
      table.complain(key, error.message);
    } else {
      table.complain_foreign(key, error);
    }
  }
  return std::nullopt;
}

/// A profile given by name, in a separate file, or in a table; without a name if none is given.
Profile read_profile(TableReader& simulator, const std::filesystem::path& folder) {
  if (!simulator.has("profile")) return {};
  const Node* node = simulator.take("profile");
  if (node != nullptr && std::holds_alternative<Table>(node->value)) {
    auto table = simulator.table("profile");
    return read_profile_table(*table);
  }
  const auto name = simulator.text("profile");
  if (!name) return {};
  return named_profile(simulator, "profile", *name, folder).value_or(Profile{});
}

/// [simulator]: how evaluations are made.
void read_simulator(TableReader& root, Campaign& campaign, const std::filesystem::path& folder) {
  static const std::vector<std::string> kKinds = {"builtin", "command"};
  static const std::vector<std::string> kKindsNotYet = {"argos"};
  auto table = root.table("simulator");
  if (!table) return;
  if (table->choice("kind", kKinds, kKindsNotYet) == "command") {
    campaign.target = read_target(*table, folder);
  } else {
    campaign.profile = read_profile(*table, folder);
  }
  table->finish();
}

/// A campaign that names no profile has the one of its first mission's robot.
void complete_profile(Campaign& campaign) {
  if (campaign.target || !campaign.profile.name.empty()) return;
  const Robot robot = campaign.missions.empty() ? rvr() : campaign.missions[0].mission.robot;
  campaign.profile = built_in_profile(usual_profile(robot)).value();
}

/// [[mission]]: missions of the simulator, or names and instances for programs.
void read_campaign_missions(TableReader& root, Campaign& campaign,
                            const std::filesystem::path& folder) {
  if (campaign.target) {
    campaign.missions = read_target_missions(root, folder);
    return;
  }
  for (MissionEntry& entry : read_missions(root, folder))
    campaign.missions.push_back({std::move(entry), {}});
  check_pictures(root, campaign);
}

/// Copies the race options that concern programs to the target.
void complete_target(Campaign& campaign) {
  if (!campaign.target) return;
  campaign.target->prints_time = campaign.race.max_time > 0;
  campaign.target->min_measurable_time = campaign.race.min_measurable_time;
}

/// Adds a profile for the tests. The campaign's own profile may be given too, and is used anyway.
void add_test_profile(TableReader& tests, std::string_view key, Profile profile,
                      Campaign& campaign) {
  const bool is_own = profile.name == campaign.profile.name;
  if (is_own && profile == campaign.profile) return;
  const auto known = std::ranges::find(campaign.test_profiles, profile.name, &Profile::name);
  if (const auto why = complaint_about_source(profile.name)) {
    tests.complain(key, *why);
  } else if (is_own) {
    tests.complain(key, "the campaign has another profile " + profile.name +
                            ", whose scores would be mixed up with these; give it another name");
  } else if (known != campaign.test_profiles.end()) {
    tests.complain(key, "the profile " + profile.name + " is named twice");
  } else {
    campaign.test_profiles.push_back(std::move(profile));
  }
}

/// [tests]: the profiles under which the winners are tested. `profiles` lists names and files, and
/// each [[tests.profile]] is a complete profile.
void read_tests(TableReader& root, const std::filesystem::path& folder, Campaign& campaign) {
  auto tests = root.table("tests");
  if (!tests) return;
  if (campaign.target) {
    tests->complain("profiles",
                    "programs evaluate here, and the simulator's profiles do not apply to them");
    tests->take("profiles");
    tests->take("profile");
    return tests->finish();
  }
  for (const std::string& word : tests->texts("profiles").value_or(std::vector<std::string>{})) {
    if (auto profile = named_profile(*tests, "profiles", word, folder))
      add_test_profile(*tests, "profiles", std::move(*profile), campaign);
  }
  for (TableReader& table : tests->tables("profile"))
    add_test_profile(*tests, "profile", read_profile_table(table), campaign);
  tests->finish();
}

void read_dashboard(TableReader& root, Campaign& campaign) {
  auto table = root.table("dashboard");
  if (!table) return;
  campaign.dashboard_bind = read_bind(*table).value_or("");
  table->finish();
}

/// The error if the method's race cannot run on one of the missions.
std::optional<Error> check_race(const Campaign& campaign, const Method& method) {
  const auto space = MethodSpace::make(method, static_cast<int>(campaign.digits));
  if (!space) return space.error();
  Repair repair;  // only its presence matters
  if (!campaign.repair.empty()) {
    repair = [](const Configuration& whole) -> Expected<Configuration> { return whole; };
  }
  std::optional<std::int64_t> checked;  // missions differ only in their number of instances
  for (const CampaignMission& mission : campaign.missions) {
    const Scenario scenario = race_on(campaign, mission);
    if (checked == scenario.n_instances) continue;
    checked = scenario.n_instances;
    const auto search = start_search(space->parameters(), scenario, method.search, space->initial(),
                                     repair, space->neighbourhood());
    if (search) continue;
    Error error = search.error();
    if (campaign.missions.size() > 1) {
      error.message = "mission \"" + mission.mission.name + "\": " + error.message;
    }
    return error;
  }
  return std::nullopt;
}

/// The error if the budget may be enough for more candidates than a design can have. Each candidate
/// takes at least one experiment, in a race those before the first test. (A race whose programs
/// reject most candidates at once may need more; then its design ends with an error.)
std::optional<Error> check_candidates(const Campaign& campaign, const Method& method) {
  const bool is_race = words_of(method.search).has_tests;
  const std::int64_t most = kCandidatesPerDesign * (is_race ? campaign.race.first_test : 1);
  const bool fits = std::ranges::all_of(campaign.missions, [&](const CampaignMission& mission) {
    return design_budget(campaign, mission, method) <= most;
  });
  if (fits) return std::nullopt;
  return Error{ErrorKind::BadInput,
               "with so many experiments it may try more than " +
                   std::to_string(kCandidatesPerDesign) +
                   " candidates, the most that a design can have: at most " + std::to_string(most) +
                   " experiments are possible",
               is_race && campaign.race.min_experiments ? "min_experiments" : "max_experiments"};
}

/// The inputs of the method's networks.
NetworkInputs inputs_of(const Method& method, const Flavour& flavour) {
  if (method.baseline.empty() || method.baseline == kRandomMachine) return method.inputs;
  return std::get<Network>(parse_controller(method.baseline, flavour).value()).inputs;
}

/// Checks whether methods, profiles and the missions' robots fit together.
void check_robots(TableReader& root, const Campaign& campaign) {
  if (campaign.target) return;
  const std::string other = ", or a mission of another robot";
  for (const CampaignMission& mission : campaign.missions) {
    const Robot& robot = mission.mission.robot;
    const std::string of = "mission \"" + mission.mission.name + "\": ";
    for (const Method& method : campaign.methods) {
      const auto flavour = flavour_of(method);
      if (!flavour) continue;
      if (const auto why = misfit(**flavour, robot))
        root.complain("method", of + *why + "; choose another flavour" + other);
      if (method.architecture != Architecture::Network) continue;
      if (const auto why = misfit(inputs_of(method, **flavour), robot))
        root.complain("method", of + *why + "; choose other inputs" + other);
    }
    const auto complain_of = [&](std::string_view key, const Profile& profile) {
      if (const auto why = misfit(profile, robot))
        root.complain(key, of + *why + "; choose another profile" + profiles_text(robot) + other);
    };
    complain_of("simulator", campaign.profile);
    for (const Profile& profile : campaign.test_profiles)
      complain_of("tests", profile);
  }
}

/// Names that would mix up scores or modules in a store, which distinguishes them by name. Existing
/// stores with such names can still be read.
std::vector<Error> mixed_names(const Campaign& campaign, const std::string& where) {
  std::vector<Error> errors;
  const auto look_at = [&](const Profile& profile) {
    if (const auto why = complaint_about_source(profile.name))
      errors.push_back({ErrorKind::BadInput, *why, where});
    const auto ours = built_in_profile(profile.name);
    if (!ours || *ours == profile) return;
    errors.push_back({ErrorKind::BadInput,
                      "the profile `" + profile.name +
                          "` is built in with other values; give the profile another name",
                      where});
  };
  if (!campaign.target) look_at(campaign.profile);
  for (const Profile& profile : campaign.test_profiles)
    look_at(profile);
  std::map<std::string, const Method*> known;
  for (const Method& method : campaign.methods) {
    const Method& first = *known.try_emplace(method.flavour, &method).first->second;
    if (first.own_flavour == method.own_flavour) continue;
    errors.push_back({ErrorKind::BadInput,
                      "methods \"" + first.name + "\" and \"" + method.name +
                          "\" have two flavours of the name " + method.flavour +
                          "; give one of the files another name",
                      where});
  }
  return errors;
}

/// Refuses more designs than evaluations of a coordinator can have as keys.
void check_designs(TableReader& root, const Campaign& campaign) {
  std::int64_t designs = 0;
  for (const Method& method : campaign.methods)
    designs += repetitions_of(campaign, method);
  designs *= static_cast<std::int64_t>(campaign.missions.size());
  if (designs <= kDesignsPerCampaign) return;
  const std::string why = "the campaign would have " + std::to_string(designs) +
                          " designs, and at most " + std::to_string(kDesignsPerCampaign) +
                          " are possible: take fewer repetitions, missions or methods, or make two "
                          "campaigns";
  auto table = root.table("campaign");
  if (table && table->has("repetitions")) {
    table->complain("repetitions", why);
  } else {
    root.complain("mission", why);
  }
}

/// Refuses more tests of a winner, those under further profiles included, than have ids.
void check_tests(TableReader& root, const Campaign& campaign) {
  const auto profiles = static_cast<std::int64_t>(campaign.test_profiles.size());
  for (const CampaignMission& mission : campaign.missions) {
    const std::int64_t tests = mission.test_count * (1 + profiles);
    if (tests < kPairsPerCandidate) continue;
    root.complain("tests", "mission \"" + mission.mission.name + "\": a winner would have " +
                               std::to_string(tests) + " tests under " +
                               counted(1 + profiles, "profile") + ", and at most " +
                               std::to_string(kPairsPerCandidate - 1) +
                               " are possible; make the `count` of its tests smaller");
  }
}

/// Checks that need the whole campaign; done last, when there are no other errors.
void complain_about_races(TableReader& root, Campaign& campaign) {
  auto race = root.table("race");
  for (const Error& error : check_budget(campaign))
    race->complain(race->has(error.where) ? error.where : "max_experiments", error.message);
}

}  // namespace

std::optional<std::string> complaint_about_source(const std::string& profile) {
  if (profile != "real" && profile != "command") return std::nullopt;
  return "scores of the source " + profile + " are not simulated; give the profile another name";
}

std::vector<Error> check_budget(const Campaign& campaign) {
  std::vector<Error> errors;
  if (campaign.only_test) return errors;
  for (const Method& method : campaign.methods) {
    if (!method.baseline.empty()) continue;
    auto error = check_candidates(campaign, method);
    if (!error) error = check_race(campaign, method);
    if (!error) continue;
    const bool is_budget = error->where == "max_experiments" || error->where == "min_experiments";
    const std::string where = error->where.empty() || is_budget ? "" : error->where + ": ";
    error->message = "method \"" + method.name + "\": " + where + error->message;
    errors.push_back(std::move(*error));
  }
  return errors;
}

CampaignOrErrors parse_campaign(std::string_view text, const std::filesystem::path& file,
                                std::optional<std::int64_t> budget) {
  const auto document = parse_document(text, file.string());
  if (!document) return tl::unexpected(std::vector<Error>{document.error()});
  Complaints complaints(file.string());
  TableReader root(*document, "", complaints);
  Campaign campaign;
  read_format(root);
  read_identity(root, campaign, file);
  const std::filesystem::path folder = file.parent_path();
  read_simulator(root, campaign, folder);
  read_campaign_missions(root, campaign, folder);
  complete_profile(campaign);
  read_tests(root, folder, campaign);
  campaign.methods = read_methods(root, folder, campaign.target.has_value());
  read_race(root, folder, campaign);
  complete_target(campaign);
  read_workers(root, folder, campaign);
  read_dashboard(root, campaign);
  root.finish();
  if (complaints.empty()) {
    check_robots(root, campaign);
    check_designs(root, campaign);
    check_tests(root, campaign);
  }
  if (budget) {
    campaign.race.max_experiments = *budget;
    campaign.race.max_time = 0;
    campaign.race.min_experiments.reset();
  } else if (complaints.empty()) {
    complain_about_races(root, campaign);
  }
  if (!complaints.empty()) {
    return tl::unexpected(
        complaints_about(*document, TomlKind::Campaign, file.string(), complaints));
  }
  return campaign;
}

CampaignOrErrors read_campaign(const std::filesystem::path& file,
                               std::optional<std::int64_t> budget) {
  auto text = read_file(file, "campaign");
  if (text) {
    auto campaign = parse_campaign(*text, file, budget);
    if (campaign) {
      if (auto mixed = mixed_names(*campaign, file.string()); !mixed.empty())
        return tl::unexpected(std::move(mixed));
    }
    if (campaign || !parse_mission(*text, file)) return campaign;
    return tl::unexpected(
        std::vector<Error>{{ErrorKind::BadInput,
                            "this is a mission, not a campaign: a campaign file names it "
                            "([[mission]] with preset = \"" +
                                file.filename().string() +
                                "\"), and has a method and a budget; `swarmsmith init` writes one",
                            file.string()}});
  }
  Error error = std::move(text.error());
  if (error.kind == ErrorKind::NotFound) error.message += "; `swarmsmith init` writes one";
  if (std::error_code none; std::filesystem::is_directory(file, none)) {
    error.message = "this is a folder; name the campaign file in it, such as " +
                    (file / "campaign.toml").string();
  }
  return tl::unexpected(std::vector<Error>{std::move(error)});
}

Campaign demo_campaign() {
  constexpr std::string_view kText = R"(format = 1
[campaign]
name = "demo"
store = "demo.db"
[[mission]]
name = "color_selection"
[[method]]
name = "watermelon"
[[method]]   # what a person writes first: drive on, and stop on yellow, which counts most
name = "by_hand"
baseline = "--nstates 2 --s0 0 --rwm0 5 --n0 1 --n0x0 0 --c0x0 6 --p0x0 1 --l0x0 3 --s1 1"
[[method]]
name = "random"
baseline = "random"
[race]
max_experiments = 2_000
)";
  auto campaign = parse_campaign(kText, "demo.toml");
  return std::move(campaign.value());
}

}  // namespace swarmsmith
