#include "coordinator/service/telemetry.h"

#include <algorithm>

namespace swarmsmith {
namespace {

constexpr Duration kRenewEvery = std::chrono::seconds(1);
constexpr Duration kPointEvery = std::chrono::milliseconds(90);

}  // namespace

double RateWindow::update(TimePoint now, std::int64_t count) {
  if (points_.empty() || now - points_.back().first >= kPointEvery)
    points_.emplace_back(now, count);
  // Two points always stay, even if both are older than the window: a rate needs two.
  while (points_.size() > 2 && now - points_.front().first > window_)
    points_.pop_front();
  const double seconds = std::chrono::duration<double>(now - points_.front().first).count();
  return seconds > 0 ? static_cast<double>(count - points_.front().second) / seconds : 0;
}

Telemetry::Telemetry(const std::vector<TelemetryCampaign>& campaigns, TimePoint start)
    : start_(start) {
  for (const TelemetryCampaign& campaign : campaigns) {
    ProgressModel progress(campaign.designs, false, campaign.searches);
    for (const DesignStateRow& row : campaign.states)
      progress.add(row);
    for (const TestedDesign& tested : campaign.tested)
      progress.add(tested);
    for (const CommandRow& row : campaign.commands)
      progress.add(row);
    campaigns_.push_back({.progress = std::move(progress)});
    campaigns_.back().status.name = campaign.name;
    campaigns_.back().status.state = "running";
    campaigns_.back().status.max_time = campaign.max_time;
    campaigns_.back().status.costs = campaign.costs;
  }
}

void Telemetry::on_rows(std::size_t index, std::span<const Row> rows, TimePoint now) {
  Campaign& campaign = campaigns_[index];
  for (const Row& row : rows) {
    campaign.progress.add(row);
    if (const auto* state = std::get_if<CampaignStateRow>(&row))
      campaign.status.state = state->state;
    const auto* step = std::get_if<RaceStepRow>(&row);
    if (step == nullptr) continue;
    const auto [last, is_first] = campaign.last_step.try_emplace(step->design, now);
    if (!is_first) campaign.status.step_time.observe(now - last->second);
    last->second = now;
  }
}

void Telemetry::on_appended(std::size_t index, std::uint64_t ticket, TimePoint now) {
  campaigns_[index].uncommitted.emplace_back(ticket, now);
}

void Telemetry::on_committed(std::size_t index, std::uint64_t ticket, TimePoint now) {
  Campaign& campaign = campaigns_[index];
  while (!campaign.uncommitted.empty() && campaign.uncommitted.front().first <= ticket) {
    campaign.status.commit_time.observe(now - campaign.uncommitted.front().second);
    campaign.uncommitted.pop_front();
  }
}

void Telemetry::set_wal_bytes(std::size_t index, std::int64_t bytes) {
  campaigns_[index].status.wal_bytes = bytes;
}

void Telemetry::set_trouble(std::size_t index, const std::string& trouble) {
  campaigns_[index].status.trouble = trouble;
}

std::size_t Telemetry::queued_units() const {
  std::size_t units = 0;
  for (const Campaign& campaign : campaigns_)
    units += campaign.uncommitted.size();
  return units;
}

void Telemetry::renew_lists(const Coordinator& coordinator, TimePoint now) {
  const std::vector<CampaignMeters>& meters = coordinator.scheduler().leases().meters();
  auto lists = std::make_shared<std::vector<CampaignStatus>>();
  for (std::size_t i = 0; i < campaigns_.size(); ++i) {
    CampaignStatus& status = campaigns_[i].status;
    if (i < meters.size()) status.meters = meters[i];
    status.designs = campaigns_[i].progress.designs();
    status.queued_units = static_cast<std::int64_t>(campaigns_[i].uncommitted.size());
    if (const auto& stopped = coordinator.stopped(static_cast<std::uint32_t>(i)); stopped) {
      status.trouble = *stopped;
    }
    lists->push_back(status);
  }
  lists_ = std::move(lists);
  fleet_ = std::make_shared<const std::vector<WorkerStatus>>(coordinator.fleet(now));
  renewed_ = now;
}

LiveStatus Telemetry::status(const Coordinator& coordinator, TimePoint now, bool all) {
  std::int64_t used = 0;
  for (const Campaign& campaign : campaigns_)
    used += campaign.progress.totals().used;
  if (all || !lists_ || now - renewed_ >= kRenewEvery) renew_lists(coordinator, now);
  LiveStatus status = coordinator.status();
  status.uptime_s = std::chrono::duration<double>(now - start_).count();
  status.evaluations_per_s = done_.update(now, status.done);
  status.used_per_s = used_.update(now, used);
  status.bytes_in = bytes_in_;
  status.bytes_out = bytes_out_;
  status.fleet = fleet_;
  status.quarantine = coordinator.quarantine(now);
  status.campaigns = lists_;
  return status;
}

}  // namespace swarmsmith
