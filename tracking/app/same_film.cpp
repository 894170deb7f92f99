#include "tracking/app/same_film.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <vector>

#include "base/id.h"
#include "base/plain_text.h"
#include "sim/control/reference_model.h"
#include "storage/store.h"
#include "tracking/scoring/real_run_rows.h"

namespace swarmsmith {
namespace {

/// With starts that differ by less, a correction of one of them would not help: the runs differ in
/// their cameras, or in how a store rounds their starts.
constexpr double kSameStart_s = 0.001;

/// A part of a film, on the clock of its camera.
struct Part {
  std::string film;
  double from_s = 0;
  double to_s = 0;
};

std::optional<Part> part_of(const std::string& sha256, const Observations& observations,
                            const std::vector<double>& starts_s, double duration_s) {
  for (std::size_t i = 0; i < observations.cameras.size() && i < starts_s.size(); ++i) {
    const CameraRecord& camera = observations.cameras[i];
    if (camera.sha256 == sha256) return Part{camera.file, starts_s[i], starts_s[i] + duration_s};
  }
  return std::nullopt;
}

double duration_of(const RunLog& log) {
  return log.mission.cycles * kControlPeriod_s;
}

/// A quote of the command line or of a store's file is a quote in SQL as well.
std::string in_sql(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) {
    quoted += letter;
    if (letter == '\'') quoted += letter;
  }
  return quoted + "'";
}

/// The other runs of a store that show a film.
OrRefusal<std::set<std::int64_t>> runs_of(StoreReader& store, const std::string& sha256,
                                          std::optional<RealRunId> own) {
  std::set<std::int64_t> runs;
  const auto end = store.query(
      "SELECT run FROM v_real_videos WHERE sha256 = " + in_sql(sha256), {},
      [](const std::vector<std::string>&) {},
      [&](const std::vector<StoreReader::Cell>& cells) { runs.insert(cells[0].integer()); });
  if (!end) return refused(ExitCode::Store, end.error());
  if (own) runs.erase(own->value);
  return runs;
}

std::string span_text(const Part& part) {
  return fmt::format("from {:.2f} s to {:.2f} s", part.from_s, part.to_s);
}

}  // namespace

OrRefusal<void> check_same_film(const AnalysedRun& run, const std::string& key,
                                const std::string& store, std::optional<RealRunId> own,
                                Output& output) {
  std::error_code trouble;
  if (!std::filesystem::exists(store, trouble)) return {};
  const auto reader = StoreReader::open(store);
  if (!reader) return refused(ExitCode::Store, reader.error());
  for (const CameraRecord& camera : run.observations.cameras) {
    const auto others = runs_of(**reader, camera.sha256, own);
    if (!others) return tl::unexpected(others.error());
    const auto mine = part_of(camera.sha256, run.observations, run.starts_s, duration_of(run.log));
    for (const std::int64_t other : *others) {
      const auto rows = (*reader)->real_run(RealRunId{other});
      if (!rows || rows->key == key) continue;
      const auto stored = stored_run(*rows);
      // A run that cannot be read again cannot be compared.
      if (!stored || !mine) continue;
      const auto starts_s = starts_of(stored->observations, stored->log);
      if (!starts_s) continue;
      const auto its =
          part_of(camera.sha256, stored->observations, *starts_s, duration_of(stored->log));
      if (!its) continue;
      const std::string word = to_string(RealRunId{other});
      if (its->from_s < mine->to_s && mine->from_s < its->to_s) {
        const std::string at = " --store " + command_word(store);
        std::string advice = fmt::format(
            "If the start of {} is wrong, correct it: `swarmsmith track rescore {} "
            "--start \"{:.3f} s\"{}`",
            word, word, run.starts_s.front(), at);
        if (std::abs(its->from_s - mine->from_s) < kSameStart_s) {
          advice = fmt::format(
              "Score it with the start and the videos of {}, or into another store", word);
        }
        if (own) {
          advice = fmt::format(
              "Leave one of them out of the statistics: `swarmsmith track override "
              "{} --verdict invalid --who NAME --reason TEXT{}`",
              to_string(*own), at);
        }
        return refused(ExitCode::Store,
                       {ErrorKind::Conflict,
                        fmt::format("{} is of this film {}, and this run would be of it {}: it "
                                    "would count twice. {}",
                                    word, span_text(*its), span_text(*mine), advice),
                        camera.file});
      }
      print_note(output, fmt::format("note: {} is of the same film, {}; this run is of it {}", word,
                                     span_text(*its), span_text(*mine)));
    }
  }
  return {};
}

}  // namespace swarmsmith
