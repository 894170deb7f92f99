#include "coordinator/service/metrics_text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string_view>
#include <utility>

namespace swarmsmith {
namespace {

using Labels = std::vector<std::pair<std::string_view, std::string>>;

/// Writes the samples of one metric.
class Samples {
 public:
  Samples(std::string& out, std::string_view name) : out_(out), name_(name) {}

  template <class Number>
  void add(const Labels& labels, Number value, std::string_view suffix = "") {
    out_ += name_;
    out_ += suffix;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      out_ += i == 0 ? '{' : ',';
      out_ += labels[i].first;
      out_ += "=\"";
      for (const char c : labels[i].second) {
        if (c == '\\' || c == '"') out_ += '\\';
        c == '\n' ? out_ += "\\n" : out_ += c;
      }
      out_ += '"';
    }
    if (!labels.empty()) out_ += '}';
    fmt::format_to(std::back_inserter(out_), " {}\n", value);
  }

  void add(const Labels& labels, const Histogram& histogram) {
    Labels with_bound = labels;
    with_bound.emplace_back("le", "");
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
      total += histogram.counts[i];
      with_bound.back().second =
          i < Histogram::kBounds.size() ? fmt::format("{}", Histogram::kBounds[i]) : "+Inf";
      add(with_bound, total, "_bucket");
    }
    add(labels, histogram.sum, "_sum");
    add(labels, total, "_count");
  }

 private:
  std::string& out_;
  std::string_view name_;
};

struct Metric {
  std::string_view name;
  std::string_view type;
  std::string_view help;
  std::function<void(const LiveStatus&, Samples&)> write;
};

/// One number for the whole coordinator.
template <class Field>
auto plain(Field LiveStatus::*field) {
  return [field](const LiveStatus& status, Samples& out) { out.add({}, status.*field); };
}

/// One number or histogram for each campaign.
template <class Get>
auto of_campaigns(Get get) {
  return [get](const LiveStatus& status, Samples& out) {
    if (!status.campaigns) return;
    for (const CampaignStatus& campaign : *status.campaigns)
      out.add({{"campaign", campaign.name}}, get(campaign));
  };
}

/// One number for each design.
template <class Get>
auto of_designs(Get get) {
  return [get](const LiveStatus& status, Samples& out) {
    if (!status.campaigns) return;
    for (const CampaignStatus& campaign : *status.campaigns) {
      for (const DesignStatus& design : campaign.designs) {
        out.add({{"campaign", campaign.name}, {"design", to_string(design.id)}}, get(design));
      }
    }
  };
}

void write_failed(const LiveStatus& status, Samples& out) {
  if (!status.campaigns) return;
  for (const CampaignStatus& campaign : *status.campaigns) {
    out.add({{"campaign", campaign.name}, {"reason", "no score"}}, campaign.meters.no_score);
    out.add({{"campaign", campaign.name}, {"reason", "timed out"}}, campaign.meters.timed_out);
  }
}

auto by_reason(std::map<std::string, std::uint64_t> LiveStatus::*counts) {
  return [counts](const LiveStatus& status, Samples& out) {
    for (const auto& [reason, count] : status.*counts)
      out.add({{"reason", reason}}, count);
  };
}

void write_workers(const LiveStatus& status, Samples& out) {
  out.add({{"state", "connected"}}, status.workers - status.quarantined);
  out.add({{"state", "quarantined"}}, status.quarantined);
  out.add({{"state", "gone"}}, status.gone_workers);
}

void write_idle(const LiveStatus& status, Samples& out) {
  for (std::size_t i = 0; i < kIdleCauses; ++i) {
    out.add({{"cause", std::string(name_of(static_cast<IdleCause>(i)))}},
            status.slot_times.idle[i]);
  }
}

std::vector<Metric> pool_metrics() {
  return {
      {"swarmsmith_requeued_total", "counter", "Leases that went back to the queue",
       plain(&LiveStatus::requeued)},
      {"swarmsmith_expired_total", "counter", "Leases without progress that were taken back",
       plain(&LiveStatus::expired)},
      {"swarmsmith_duplicates_total", "counter", "Results that were known before",
       plain(&LiveStatus::duplicates)},
      {"swarmsmith_conflicts_total", "counter", "Results that differ from the known one",
       plain(&LiveStatus::conflicts)},
      {"swarmsmith_audits_total", "counter",
       "Results that were evaluated again and compared bit by bit", plain(&LiveStatus::audits)},
      {"swarmsmith_rulings_total", "counter", "Evaluations of the referee, audits included",
       plain(&LiveStatus::rulings)},
      {"swarmsmith_referee_queue", "gauge", "Evaluations that wait for the referee",
       plain(&LiveStatus::referee_queue)},
      {"swarmsmith_unleased_results_total", "counter",
       "Results of tasks that were never leased to their senders", plain(&LiveStatus::unleased)},
      {"swarmsmith_unknown_results_total", "counter", "Results without a lease",
       plain(&LiveStatus::unknown)},
      {"swarmsmith_malformed_total", "counter", "Frames that were dropped, by what was wrong",
       by_reason(&LiveStatus::malformed_by)},
      {"swarmsmith_over_budget_total", "counter",
       "Requests of peers beyond their budgets, by kind: rows, hellos, answers, commands",
       by_reason(&LiveStatus::over_budget)},
      {"swarmsmith_refused_total", "counter", "Connections that were kept out, by reason",
       by_reason(&LiveStatus::refused)},
      {"swarmsmith_lost_workers_total", "counter", "Workers that disappeared",
       plain(&LiveStatus::lost_workers)},
      {"swarmsmith_reconnects_total", "counter", "Hellos of workers that had been here before",
       plain(&LiveStatus::reconnects)},
      {"swarmsmith_received_bytes_total", "counter", "Bytes of frames from peers",
       plain(&LiveStatus::bytes_in)},
      {"swarmsmith_sent_bytes_total", "counter", "Bytes of frames to peers",
       plain(&LiveStatus::bytes_out)},
      {"swarmsmith_slot_seconds_total", "counter", "Time of all slots, by the workers' heartbeats",
       [](const LiveStatus& status, Samples& out) { out.add({}, status.slot_times.slots); }},
      {"swarmsmith_busy_slot_seconds_total", "counter", "Slot time in which slots evaluated",
       [](const LiveStatus& status, Samples& out) { out.add({}, status.slot_times.busy); }},
      {"swarmsmith_idle_slot_seconds_total", "counter", "Slot time without an evaluation, by cause",
       write_idle},
      {"swarmsmith_uptime_seconds", "gauge", "Age of this process", plain(&LiveStatus::uptime_s)},
      {"swarmsmith_workers", "gauge", "Workers by state; gone ones for a quarter of an hour",
       write_workers},
      {"swarmsmith_slots", "gauge", "Slots of connected workers", plain(&LiveStatus::slots)},
      {"swarmsmith_ready_tasks", "gauge", "Tasks that wait for a slot", plain(&LiveStatus::ready)},
      {"swarmsmith_leased_tasks", "gauge", "Tasks that workers hold", plain(&LiveStatus::leased)},
      {"swarmsmith_credit_tasks", "gauge", "Tasks that workers have room for",
       plain(&LiveStatus::credit)},
      {"swarmsmith_uncommitted_outcomes", "gauge", "Outcomes that are not on disk yet",
       plain(&LiveStatus::uncommitted)},
      {"swarmsmith_plaintext", "gauge", "1 when other hosts can connect without keys",
       [](const LiveStatus& status, Samples& out) {
         out.add({}, status.insecure_plaintext ? 1 : 0);
       }},
  };
}

std::vector<Metric> campaign_metrics() {
  return {
      {"swarmsmith_leased_total", "counter", "Tasks leased, each time that a worker got one",
       of_campaigns([](const CampaignStatus& one) { return one.meters.leased; })},
      {"swarmsmith_done_total", "counter", "Evaluations with a score",
       of_campaigns([](const CampaignStatus& one) { return one.meters.done; })},
      {"swarmsmith_rejected_total", "counter", "Evaluations that ended without a score",
       of_campaigns([](const CampaignStatus& one) { return one.meters.rejected; })},
      {"swarmsmith_failed_total", "counter", "Attempts without a score, by reason", write_failed},
      {"swarmsmith_campaign_used", "gauge", "Experiments that the races of a campaign have used",
       of_campaigns([](const CampaignStatus& one) { return one.totals().used; })},
      {"swarmsmith_campaign_budget", "gauge", "Budget of the races in experiments",
       of_campaigns([](const CampaignStatus& one) { return one.totals().budget; })},
      {"swarmsmith_campaign_left", "gauge",
       "Experiments that the races may still use; none of a race that is over",
       of_campaigns([](const CampaignStatus& one) { return one.totals().left; })},
      {"swarmsmith_design_used", "gauge", "Experiments that a design's race has used",
       of_designs([](const DesignStatus& one) { return one.used; })},
      {"swarmsmith_design_budget", "gauge", "Experiments that a design's race may use",
       of_designs([](const DesignStatus& one) { return one.budget; })},
      {"swarmsmith_paused_designs", "gauge", "Paused designs",
       of_campaigns([](const CampaignStatus& one) { return one.totals().paused; })},
      {"swarmsmith_writer_queue_units", "gauge", "Units of rows that a store has not committed",
       of_campaigns([](const CampaignStatus& one) { return one.queued_units; })},
      {"swarmsmith_wal_bytes", "gauge", "Size of a store's write-ahead log",
       of_campaigns([](const CampaignStatus& one) { return one.wal_bytes; })},
      {"swarmsmith_evaluation_seconds", "histogram",
       "Time of an evaluation, as its worker measured",
       of_campaigns([](const CampaignStatus& one) { return one.meters.evaluation; })},
      {"swarmsmith_queue_wait_seconds", "histogram", "From wanted to first leased",
       of_campaigns([](const CampaignStatus& one) { return one.meters.queue_wait; })},
      {"swarmsmith_round_trip_seconds", "histogram", "From leased to the arrival of the score",
       of_campaigns([](const CampaignStatus& one) { return one.meters.round_trip; })},
      {"swarmsmith_commit_seconds", "histogram", "From rows given to the store to their commit",
       of_campaigns([](const CampaignStatus& one) { return one.commit_time; })},
      {"swarmsmith_step_seconds", "histogram", "From one step of a design's race to its next",
       of_campaigns([](const CampaignStatus& one) { return one.step_time; })},
  };
}

const std::vector<Metric>& all_metrics() {
  static const std::vector<Metric> metrics = [] {
    std::vector<Metric> all = campaign_metrics();
    std::vector<Metric> pool = pool_metrics();
    for (Metric& metric : pool)
      all.push_back(std::move(metric));
    return all;
  }();
  return metrics;
}

}  // namespace

std::string metrics_text(const LiveStatus& status) {
  std::string text;
  for (const Metric& metric : all_metrics()) {
    text += fmt::format("# HELP {} {}\n# TYPE {} {}\n", metric.name, metric.help, metric.name,
                        metric.type);
    Samples samples(text, metric.name);
    metric.write(status, samples);
  }
  return text;
}

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const Metric& metric : all_metrics())
    names.emplace_back(metric.name);
  return names;
}

}  // namespace swarmsmith
