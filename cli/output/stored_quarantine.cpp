#include "cli/output/stored_quarantine.h"

#include <algorithm>
#include <cstdlib>

#include "cli/output/query_output.h"

namespace swarmsmith::cli {
namespace {

/// The first schema with principals of workers.
constexpr std::int64_t kSchemaOfPrincipals = 6;

/// A value from the last quarantine event that concerns worker `w`: all workers of its principal,
/// or only itself.
std::string of_event(const std::string& value) {
  return "(SELECT " + value +
         " FROM event AS e WHERE e.kind = 'workers in quarantine' AND json_valid(e.text)"
         " AND e.text ->> '$.who' = w.principal"
         " AND coalesce(e.text ->> '$.worker', w.worker) = w.worker ORDER BY e.seq DESC LIMIT 1)";
}

}  // namespace

Expected<std::vector<QuarantineStatus>> stored_quarantine(StoreReader& store) {
  std::vector<QuarantineStatus> all;
  if (store.schema() < kSchemaOfPrincipals) return all;
  const auto rows = select(store, "SELECT principal, worker, client, " + of_event("e.time") + ", " +
                                      of_event("e.text ->> '$.reason'") +
                                      " FROM v_workers AS w WHERE state = 'quarantined'"
                                      " AND principal <> '' ORDER BY worker");
  if (!rows) return Unexpected(rows.error());
  for (const auto& cells : rows->cells) {
    const std::string& who = cells[0].text;
    const bool is_one = cells[2].text.empty() && is_blamed_by_process(who);
    // One entry stands for all workers of the principal.
    const bool is_known = !is_one && std::ranges::any_of(all, [&](const QuarantineStatus& known) {
      return known.who == who;
    });
    if (is_known) continue;
    all.push_back({.who = who,
                   .reason = cells[4].text,
                   .since = cells[3].text,
                   .worker = is_one ? cells[1].integer() : 0});
  }
  return all;
}

std::vector<std::string> quarantine_lines(const std::vector<QuarantineStatus>& quarantine,
                                          const std::string& store) {
  std::vector<std::string> lines;
  for (const QuarantineStatus& one : quarantine)
    lines.push_back(quarantine_line(one));
  if (!lines.empty()) {
    lines.push_back("`swarmsmith forgive " + store + " \"" + quarantine.front().who +
                    "\"` lets it work again");
  }
  return lines;
}

std::string workers_with_quarantine() {
  return "(SELECT w.*, iif(w.state = 'quarantined', " + of_event("e.time") +
         ", NULL) AS quarantined_since, iif(w.state = 'quarantined', " +
         of_event("e.text ->> '$.reason'") + ", NULL) AS quarantined_for FROM v_workers AS w)";
}

}  // namespace swarmsmith::cli
