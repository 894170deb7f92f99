#include "storage/internal/mend_real_runs.h"

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "storage/internal/real_run_parts.h"

namespace swarmsmith {
namespace {

using sqlite::Connection;
using sqlite::Statement;

/// The lost parts of a run.
struct Loss {
  std::vector<std::string> what;
  bool of_score = false;  ///< the score does not follow from the remaining parts
};

std::int64_t remove_orphans(Connection& connection) {
  std::int64_t removed = 0;
  const auto remove = [&](const char* table) {
    connection.execute(
        fmt::format("DELETE FROM {} WHERE run NOT IN (SELECT id FROM real_run)", table));
    removed += connection.changes();
  };
  for (const RealRunPart& part : kRealRunParts)
    remove(part.table);
  for (const char* table : kRealRunNotes)
    remove(table);
  return removed;
}

/// Finds the runs that lack parts, and corrects the numbers of their parts.
void find_lost_parts(Connection& connection, std::map<std::int64_t, Loss>& losses) {
  for (const RealRunPart& part : kRealRunParts) {
    const std::string count =
        fmt::format("(SELECT count(*) FROM {} AS p WHERE p.run = real_run.id)", part.table);
    Statement run(connection,
                  fmt::format("SELECT id FROM real_run WHERE {} <> {}", part.column, count));
    while (run.step()) {
      Loss& loss = losses[run.integer(0)];
      loss.what.emplace_back(part.column);
      loss.of_score = loss.of_score || part.is_scored;
    }
    connection.execute(fmt::format("UPDATE real_run SET {} = {}", part.column, count));
  }
}

void find_lost_calibrations(Connection& connection, std::map<std::int64_t, Loss>& losses) {
  constexpr std::pair<const char*, const char*> kNamed[] = {{"real_video", "camera_calibration"},
                                                            {"real_video", "place_calibration"},
                                                            {"real_robot", "offset_calibration"}};
  for (const auto& [table, column] : kNamed) {
    const std::string lost =
        fmt::format(" {0} <> '' AND {0} NOT IN (SELECT sha256 FROM calibration)", column);
    Statement run(connection, fmt::format("SELECT DISTINCT run FROM {} WHERE", table) + lost);
    while (run.step())
      losses[run.integer(0)].what.emplace_back("calibrations");
    connection.execute(fmt::format("UPDATE {} SET {} = '' WHERE", table, column) + lost);
  }
}

}  // namespace

std::int64_t mend_real_runs(Connection& connection) {
  const std::int64_t removed = remove_orphans(connection);
  std::map<std::int64_t, Loss> losses;
  Statement scoreless(connection,
                      "SELECT id FROM real_run WHERE id NOT IN (SELECT run FROM real_score)");
  while (scoreless.step())
    losses[scoreless.integer(0)] = {.what = {"scores"}, .of_score = true};
  find_lost_parts(connection, losses);
  find_lost_calibrations(connection, losses);
  connection.execute(
      "UPDATE real_run SET candidate = NULL WHERE candidate NOT IN (SELECT id FROM candidate)");
  Statement scoring(connection,
                    "INSERT INTO real_score (run, number, score, verdict, biased, program, reasons,"
                    " report) SELECT ?1, coalesce(max(number), 0) + 1,"
                    " iif(?2, NULL, (SELECT score FROM real_score WHERE run = ?1"
                    " ORDER BY number DESC LIMIT 1)), 'INVALID', coalesce(max(biased), 0),"
                    " 'swarmsmith recover', json_array(?3), '{}' FROM real_score WHERE run = ?1");
  for (const auto& [run, loss] : losses) {
    const std::string reason =
        fmt::format("rows of its {} were lost with the damaged store", fmt::join(loss.what, ", "));
    scoring.run(run, loss.of_score, reason);
  }
  return removed;
}

}  // namespace swarmsmith
