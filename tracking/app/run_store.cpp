#include "tracking/app/run_store.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "base/id.h"
#include "base/plain_text.h"
#include "sim/control/controller.h"
#include "sim/files/mission_file.h"
#include "sim/files/profile_file.h"
#include "tracking/app/score_arguments.h"

namespace swarmsmith {
namespace {

/// Other commands hold a store for a shorter time than these tries take.
constexpr int kTries = 20;
constexpr std::chrono::milliseconds kPause{100};

OrRefusal<std::unique_ptr<StoreReader>> read_store(const std::string& store) {
  auto reader = StoreReader::open(store);
  if (!reader) return refused(ExitCode::Store, reader.error());
  return std::move(*reader);
}

/// The cells of the first row; nothing if there is no row.
Expected<std::optional<std::vector<StoreReader::Cell>>> first_row(StoreReader& store,
                                                                  const std::string& sql) {
  std::optional<std::vector<StoreReader::Cell>> found;
  const auto end = store.query(
      sql, {.rows = 1}, [](const std::vector<std::string>&) {},
      [&](const std::vector<StoreReader::Cell>& cells) { found = cells; });
  if (!end) return Unexpected(end.error());
  return found;
}

/// The mission of a design, from its campaign.
OrRefusal<Mission> mission_of_design(StoreReader& store, DesignId design, const std::string& name) {
  const auto campaign = store.campaign_of(design);
  if (!campaign) return refused(ExitCode::NoSuchId, campaign.error());
  const auto document = parse_document(campaign->row.file, campaign->row.name);
  if (document) {
    Complaints complaints(campaign->row.name);
    TableReader root(*document, "", complaints);
    for (MissionEntry& entry : read_missions(root, "")) {
      if (entry.mission.name == name) return std::move(entry.mission);
    }
  }
  // An imported design may lack its campaign's file.
  auto built_in = built_in_mission(name);
  if (built_in) return std::move(*built_in);
  return refused(ExitCode::NoSuchId,
                 {ErrorKind::NotFound,
                  "the campaign of " + to_string(design) + " does not say what its mission \"" +
                      name + "\" is; name a mission file: --mission FILE",
                  {}});
}

/// The error for an id that is not in the store. `kind` is one of `swarmsmith ls`.
Error no_such(const std::string& what, const std::string& kind, const std::string& store) {
  return {ErrorKind::NotFound,
          what + "; `swarmsmith ls " + kind + " " + command_word(store) + "` lists them", store};
}

/// The design's winner.
OrRefusal<CandidateId> winner_of(StoreReader& reader, const std::string& store, DesignId design) {
  const auto row = first_row(reader, "SELECT best_candidate, state FROM v_designs WHERE design = " +
                                         std::to_string(design.value));
  if (!row) return refused(ExitCode::Store, row.error());
  if (!*row) {
    return refused(ExitCode::NoSuchId,
                   no_such("the store has no design " + to_string(design), "designs", store));
  }
  const StoreReader::Cell& best = (**row)[0];
  if (best.type != StoreReader::Cell::Type::Integer) {
    return refused(ExitCode::NoSuchId,
                   {ErrorKind::NotFound,
                    "design " + to_string(design) +
                        " has no winner yet; name the candidate that ran: --candidate",
                    store});
  }
  return CandidateId{best.integer()};
}

/// The machine as robots' logs contain it; a text that is not in the grammar, such as a program's,
/// is returned unchanged.
RanMachine printed_machine(const std::string& text, const std::string& flavour_name) {
  RanMachine machine{text, flavour_name};
  const auto flavour = find_flavour(flavour_name);
  if (!flavour) return machine;
  const auto controller = parse_controller(text, **flavour);
  if (controller) machine.text = print_controller(*controller, **flavour);
  return machine;
}

}  // namespace

OrRefusal<RanControl> control_of(const std::string& store, const RunLog& log) {
  auto reader = read_store(store);
  if (!reader) return tl::unexpected(std::move(reader.error()));
  RanControl control;
  if (const auto named = id_from_text<CandidateTag>(log.candidate)) {
    control.candidate = *named;
  } else {
    auto winner = winner_of(**reader, store, *id_from_text<DesignTag>(log.design));
    if (!winner) return tl::unexpected(std::move(winner.error()));
    control.candidate = *winner;
  }
  const auto row = first_row(**reader,
                             "SELECT d.mission, c.fsm_config, d.flavour FROM v_candidates AS c "
                             "JOIN v_designs AS d "
                             "ON d.design = c.design WHERE c.candidate = " +
                                 std::to_string(control.candidate.value));
  if (!row) return refused(ExitCode::Store, row.error());
  if (!*row) {
    return refused(
        ExitCode::NoSuchId,
        no_such("the store has no candidate " + to_string(control.candidate), "candidates", store));
  }
  auto mission = mission_of_design(**reader, design_of(control.candidate), (**row)[0].text);
  if (!mission) return tl::unexpected(std::move(mission.error()));
  control.mission = std::move(*mission);
  control.machine = printed_machine((**row)[1].text, (**row)[2].text);
  return control;
}

OrRefusal<void> check_mission(const RanControl& control, const RunLog& log,
                              const std::string& store) {
  if (log.mission.name == control.mission.name) return {};
  return refused(
      ExitCode::NoSuchId,
      {ErrorKind::NotFound,
       to_string(control.candidate) + " was designed for mission \"" + control.mission.name +
           "\", but the run is of mission \"" + log.mission.name + "\"",
       store});
}

OrRefusal<void> check_source(const RunLog& log, const std::string& store) {
  const std::vector<std::string> built_in = profile_names();
  bool is_profile = std::ranges::find(built_in, log.source) != built_in.end();
  std::error_code trouble;
  if (!is_profile && !store.empty() && std::filesystem::exists(store, trouble)) {
    // A store that cannot be read, or in which nothing has begun, is refused when it is written.
    if (const auto reader = StoreReader::open(store))
      is_profile = (*reader)->kept_profiles().contains(log.source);
  }
  if (!is_profile) return {};
  return refused(
      error_of(IssueCode::Config,
               "`source` is \"" + log.source +
                   "\", which is a profile of the simulator, so scores of this film would "
                   "look simulated; give it another name, such as \"real\"",
               log.name));
}

OrRefusal<std::unique_ptr<StoreAtRest>> open_store(const std::string& store,
                                                   StoreAtRest::IfMissing if_missing) {
  for (int i = 1;; ++i) {
    auto opened = StoreAtRest::open(store, if_missing);
    if (opened) return std::move(*opened);
    if (opened.error().kind != ErrorKind::Conflict || i == kTries) {
      return refused(ExitCode::Store, opened.error());
    }
    std::this_thread::sleep_for(kPause);
  }
}

OrRefusal<std::string> named_store(const std::string& option) {
  if (std::string store = store_word(option); !store.empty()) return store;
  return refused(ExitCode::Usage,
                 {ErrorKind::BadInput,
                  "no store given; name its file with --store, or set SWARMSMITH_STORE",
                  {}});
}

std::string KeptRun::verdict() const {
  const VerdictOverride* by_person = overriding(overrides);
  return by_person == nullptr ? rows.score.verdict : std::string(name_of(by_person->verdict));
}

OrRefusal<KeptRun> kept_run(const std::string& option, const std::string& word) {
  auto store = named_store(option);
  if (!store) return tl::unexpected(std::move(store.error()));
  const auto reader = read_store(*store);
  if (!reader) return tl::unexpected(reader.error());
  const auto id = id_from_text<RealRunTag>(word);
  if (!id) {
    return refused(ExitCode::Usage,
                   {ErrorKind::BadInput, "\"" + word + "\" is not a run such as r7", {}});
  }
  auto rows = (*reader)->real_run(*id);
  if (!rows) return refused(ExitCode::NoSuchId, rows.error());
  KeptRun run{std::move(*store), *id, std::move(*rows), {}};
  const auto end = (*reader)->query(
      "SELECT o.verdict, o.who, o.reason, o.scoring = r.scorings AND o.number = "
      "(SELECT max(l.number) FROM v_real_overrides AS l WHERE l.run = o.run) "
      "FROM v_real_overrides AS o JOIN v_real_runs AS r ON r.run = o.run WHERE o.run = " +
          std::to_string(id->value) + " ORDER BY o.number",
      {}, [](const std::vector<std::string>&) {},
      [&](const std::vector<StoreReader::Cell>& cells) {
        run.overrides.push_back({verdict_from_name(cells[0].text).value_or(Verdict::Invalid),
                                 cells[1].text, cells[2].text, cells[3].text == "1"});
      });
  if (!end) return refused(ExitCode::Store, end.error());
  return run;
}

}  // namespace swarmsmith
