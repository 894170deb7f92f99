#include "cli/output/status_text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include "cli/output/number_text.h"
#include "irace_core/search/stage.h"
#include "programs/cost.h"

namespace swarmsmith::cli {
namespace {

constexpr std::size_t kBar = 40;

std::string percent(double part, double whole) {
  return whole > 0 ? fmt::format("{:.0f} %", 100 * part / whole) : "-";
}

/// "1 200/3 000 (40 %)". A finished race counts as 100 %, even if it did not use its whole budget.
/// "1 200" if the budget is a time.
std::string experiments(const CampaignTotals& totals, bool is_time) {
  if (is_time) return std::to_string(totals.used);
  return fmt::format("{}/{} ({})", totals.used, totals.budget,
                     percent(static_cast<double>(totals.budget - totals.left),
                             static_cast<double>(totals.budget)));
}

CampaignTotals totals_of(const LiveStatus& status) {
  CampaignTotals totals;
  if (!status.campaigns) return totals;
  for (const CampaignStatus& campaign : *status.campaigns) {
    for (const DesignStatus& design : campaign.designs)
      totals.add(design);
  }
  return totals;
}

bool has_time_budget(const LiveStatus& status) {
  return status.campaigns && std::ranges::any_of(*status.campaigns, [](const CampaignStatus& one) {
           return one.max_time > 0;
         });
}

/// The name for people: on a single host nothing crosses a network.
std::string_view shown_name(IdleCause cause) {
  return cause == IdleCause::Network ? "on the way" : name_of(cause);
}

/// "busy 91 %  barrier 6 %  on the way 3 %": the largest share first, without shares below half a
/// percent.
std::string shares(const SlotTimes& times) {
  if (times.slots <= 0) return "no heartbeats yet";
  std::vector<std::pair<double, std::string_view>> causes;
  for (std::size_t i = 0; i < kIdleCauses; ++i)
    causes.emplace_back(times.idle[i], shown_name(static_cast<IdleCause>(i)));
  std::ranges::stable_sort(causes, std::greater<>(), [](const auto& one) { return one.first; });
  std::string text = "busy " + percent(times.busy, times.slots);
  for (const auto& [time, name] : causes) {
    if (time >= 0.005 * times.slots)
      text += fmt::format("  {} {}", name, percent(time, times.slots));
  }
  return text;
}

/// A bar with one character for each share: # for busy, and the first letter of each cause.
std::string share_bar(const SlotTimes& times) {
  if (times.slots <= 0) return "";
  std::string bar;
  double upto = times.busy;
  const auto fill = [&](double end, char c) {
    const auto columns = std::lround(kBar * std::min(1.0, end / times.slots));
    bar.resize(std::max(bar.size(), static_cast<std::size_t>(columns)), c);
  };
  fill(upto, '#');
  for (std::size_t i = 0; i < kIdleCauses; ++i) {
    upto += times.idle[i];
    fill(upto, shown_name(static_cast<IdleCause>(i)).front());
  }
  bar.resize(kBar, '.');
  return "[" + bar + "]";
}

std::string eta(const LiveStatus& status) {
  const double left = seconds_left(status);
  return left > 0 ? "  ETA " + duration_text(left, LongestUnit::Day) : "";
}

void add_head(std::vector<std::string>& lines, const LiveStatus& status) {
  if (status.campaigns) {
    for (const CampaignStatus& one : *status.campaigns) {
      const CampaignTotals totals = one.totals();
      lines.push_back(
          fmt::format("campaign {}  {}  designs {}/{}  experiments {}", one.name, one.state,
                      totals.finished, totals.designs, experiments(totals, one.max_time > 0)) +
          (one.max_time > 0 ? fmt::format("  time budget {} a design", one.max_time) : ""));
      if (!one.trouble.empty()) lines.push_back("  trouble: " + one.trouble);
    }
  }
  if (!status.running) {
    const auto interrupted = [](const CampaignStatus& one) { return one.state == "interrupted"; };
    if (status.campaigns && std::ranges::any_of(*status.campaigns, interrupted))
      lines.emplace_back(
          "no coordinator runs it now; the command that started it continues from here");
    return;
  }
  lines.push_back(fmt::format("workers {}  slots {}  {:.0f} evaluations/s  leased {}  ready {}{}",
                              status.workers, status.slots, status.evaluations_per_s, status.leased,
                              status.ready, eta(status)));
  if (!status.launcher.name.empty()) lines.push_back("launcher " + to_text(status.launcher));
  lines.push_back("last minute  " + shares(status.slot_times_last_minute));
  if (const std::string bar = share_bar(status.slot_times_last_minute); !bar.empty()) {
    lines.push_back("  " + bar);
  }
  lines.push_back("since start  " + shares(status.slot_times));
}

/// The problems that a person should look into; empty if there are none.
std::string troubles(const LiveStatus& status) {
  std::string text;
  const auto add = [&](std::string_view name, std::int64_t count) {
    if (count > 0) text += fmt::format("  {} {}", name, count);
  };
  add("failed", status.failed);
  add("rejected", status.rejected);
  add("conflicts", status.conflicts);
  add("unleased results", status.unleased);
  add("quarantined workers", status.quarantined);
  add("requeued", status.requeued);
  add("expired", status.expired);
  add("lost workers", status.lost_workers);
  add("malformed", status.malformed);
  std::int64_t over_budget = 0;
  for (const auto& [kind, count] : status.over_budget)
    over_budget += static_cast<std::int64_t>(count);
  add("over budget", over_budget);
  std::int64_t refused = 0;
  for (const auto& [reason, count] : status.refused)
    refused += static_cast<std::int64_t>(count);
  add("refused", refused);
  if (status.insecure_plaintext) text += "  NOT ENCRYPTED";
  return text;
}

/// A search without tests is not called "racing".
std::string_view shown_state(const CampaignStatus& campaign, const DesignStatus& design) {
  if (design.paused) return "paused";
  const auto is_its = [&](SearchKind kind) { return name_of(kind) == design.search; };
  const auto kind = std::ranges::find_if(all_searches(), is_its);
  const std::string_view word = campaign.word_of_design(design);
  return word == "racing" && kind != all_searches().end() ? words_of(*kind).at_work : word;
}

std::vector<std::string> design_lines(const LiveStatus& status) {
  std::vector<std::string> lines;
  if (!status.campaigns) return lines;
  const bool several = status.campaigns->size() > 1;
  int best_width = 9;
  for (const CampaignStatus& campaign : *status.campaigns) {
    const bool is_tested = std::ranges::any_of(campaign.designs, &DesignStatus::is_tested);
    best_width = std::max(best_width, (is_tested ? 17 : 9) + (campaign.costs ? 5 : 0));
  }
  // Racing designs first. Finished ones show their best score, waiting ones show nothing.
  for (const bool racing : {true, false}) {
    for (const CampaignStatus& campaign : *status.campaigns) {
      for (const DesignStatus& one : campaign.designs) {
        const bool is_racing =
            one.state == DesignState::Racing || one.state == DesignState::Testing;
        if (is_racing != racing) continue;
        const std::string part =
            one.search.empty() ? fmt::format("it {:<3}", one.iteration) : std::string(6, ' ');
        // An imported design has a best machine without a mean.
        const bool has_mean = one.best && (one.used > 0 || one.is_tested());
        const std::string budget = campaign.max_time > 0 ? fmt::format("time {}", campaign.max_time)
                                                         : std::to_string(one.budget);
        lines.push_back(
            fmt::format(
                "{:<5} {:<11}{:>9}/{:<9} {} {:<{}} {} {}{}{}", to_string(one.id),
                shown_state(campaign, one), one.used, budget, part,
                has_mean ? fmt::format("{}{:.4g}{}", campaign.costs ? "cost " : "",
                                       campaign.costs ? to_cost(one.told_mean()) : one.told_mean(),
                                       one.is_tested() ? " in tests" : "")
                         : "",
                best_width, one.mission, one.method, several ? "  " + campaign.name : "",
                one.stage.empty() ? "" : "  " + one.stage) +
            (is_over(one.state) && !one.reason.empty() ? "  (" + one.reason + ")" : ""));
      }
    }
  }
  return lines;
}

bool has_stages(const LiveStatus& status) {
  const auto has = [](const DesignStatus& design) { return !design.stage.empty(); };
  return status.campaigns &&
         std::ranges::any_of(*status.campaigns, [&](const CampaignStatus& campaign) {
           return std::ranges::any_of(campaign.designs, has);
         });
}

struct Host {
  std::int64_t workers = 0;
  std::int64_t gone = 0;
  std::int64_t slots = 0;
  std::int64_t held = 0;
  std::int64_t done = 0;
  std::int64_t failed = 0;
  double rate = 0;
  double busy_slots = 0;
  double silent = 0;  ///< seconds; the longest of its connected workers

  double busy() const { return slots > 0 ? busy_slots / static_cast<double>(slots) : 0; }
};

std::map<std::string, Host> hosts_of(const LiveStatus& status) {
  std::map<std::string, Host> hosts;
  if (!status.fleet) return hosts;
  for (const WorkerStatus& worker : *status.fleet) {
    Host& host = hosts[worker.host];
    host.done += worker.done;
    host.failed += worker.failed;
    if (worker.state != "connected") {
      ++host.gone;
      continue;
    }
    ++host.workers;
    host.slots += worker.slots;
    host.held += worker.held;
    host.rate += worker.done_per_s;
    host.busy_slots += worker.busy * static_cast<double>(worker.slots);
    host.silent = std::max(host.silent, worker.last_heard_s);
  }
  return hosts;
}

/// Worst hosts first: with failures, with lost workers, with the smallest busy share.
std::vector<std::string> host_lines(const LiveStatus& status) {
  const std::map<std::string, Host> hosts = hosts_of(status);
  std::vector<std::pair<std::string, Host>> sorted(hosts.begin(), hosts.end());
  std::ranges::stable_sort(sorted, [](const auto& a, const auto& b) {
    return std::tuple(-a.second.failed, -a.second.gone, a.second.busy()) <
           std::tuple(-b.second.failed, -b.second.gone, b.second.busy());
  });
  std::vector<std::string> lines;
  lines.reserve(sorted.size());
  for (const auto& [name, host] : sorted) {
    lines.push_back(fmt::format(
        "{:<20.20} {:>4} {:>4} {:>5} {:>5} {:>5.0f}% {:>8.1f} {:>6} {:>6.1f}s", name, host.workers,
        host.gone, host.slots, host.held, 100 * host.busy(), host.rate, host.failed, host.silent));
  }
  return lines;
}

/// Adds as many rows as fit, and the number of the others.
void add_table(std::vector<std::string>& lines, const std::string& headline,
               const std::vector<std::string>& table, std::size_t room) {
  // Needs room for a blank line, the headline and at least one row.
  if (table.empty() || room < 3) return;
  lines.emplace_back();
  lines.push_back(headline);
  const bool all = table.size() + 2 <= room;
  const std::size_t rows = all ? table.size() : room - 3;
  lines.insert(lines.end(), table.begin(), table.begin() + static_cast<std::ptrdiff_t>(rows));
  if (!all) lines.push_back(fmt::format("... and {} more", table.size() - rows));
}

}  // namespace

std::vector<std::string> status_lines(const LiveStatus& status, const Screen& screen) {
  std::vector<std::string> lines;
  add_head(lines, status);
  if (!status.trouble.empty()) lines.push_back("NOTHING IS STORED: " + status.trouble);
  if (const std::string text = troubles(status); !text.empty()) lines.push_back("look at" + text);
  for (const QuarantineStatus& one : status.quarantine)
    lines.push_back(quarantine_line(one) + " (`swarmsmith forgive` lets it work again)");
  const std::vector<std::string> designs = design_lines(status);
  const std::vector<std::string> hosts = host_lines(status);
  const std::size_t room = screen.height > lines.size() ? screen.height - lines.size() : 0;
  // Each table gets half of the lines, and the lines that the other does not need.
  const std::size_t want_hosts = hosts.empty() ? 0 : hosts.size() + 2;
  add_table(lines,
            std::string("design state           used/budget             best      mission method") +
                (has_stages(status) ? "  stage" : ""),
            designs, std::max(room / 2, room - std::min(room, want_hosts)));
  add_table(lines, "host                 here gone slots  held   busy  evals/s failed silent",
            hosts, screen.height > lines.size() ? screen.height - lines.size() : 0);
  if (lines.size() > screen.height) lines.resize(screen.height);
  for (std::string& line : lines) {
    if (line.size() > screen.width) line.resize(screen.width);
  }
  return lines;
}

std::string status_summary(const LiveStatus& status) {
  const LauncherStatus& launcher = status.launcher;
  const bool all_there =
      launcher.name.empty() || (launcher.running >= launcher.wanted && launcher.note.empty());
  return fmt::format("experiments {}  workers {}  slots {}  {:.0f}/s  {}{}{}",
                     experiments(totals_of(status), has_time_budget(status)), status.workers,
                     status.slots, status.evaluations_per_s, shares(status.slot_times_last_minute),
                     eta(status), troubles(status)) +
         (all_there ? "" : "  " + to_text(status.launcher)) +
         (status.trouble.empty() ? "" : "  NOTHING IS STORED: " + status.trouble);
}

}  // namespace swarmsmith::cli
