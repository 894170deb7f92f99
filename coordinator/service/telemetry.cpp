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
  while (points_.size() > 2 && now - points_.front().first > window_)
    points_.pop_front();
  const double seconds = std::chrono::duration<double>(now - points_.front().first).count();
  return seconds > 0 ? static_cast<double>(count - points_.front().second) / seconds : 0;
}

Telemetry::Telemetry(const std::vector<TelemetryCampaign>& campaigns, TimePoint start)
    : campaigns_(campaigns.size()), start_(start) {
  for (std::size_t i = 0; i < campaigns.size(); ++i) {
    Campaign& campaign = campaigns_[i];
    campaign.status.name = campaigns[i].name;
    for (const DesignRow& row : campaigns[i].designs) {
      campaign.place_of[row.id.value] = campaign.status.designs.size();
      campaign.status.designs.push_back({.id = row.id.value,
                                         .mission = row.mission,
                                         .method = row.method,
                                         .repetition = row.repetition,
                                         .state = DesignState::Waiting,
                                         .budget = row.budget});
    }
    for (const DesignStateRow& row : campaigns[i].states)
      add_state(campaign, row);
  }
}

void Telemetry::add_state(Campaign& campaign, const DesignStateRow& row) {
  const auto place = campaign.place_of.find(row.design.value);
  if (place == campaign.place_of.end()) return;
  DesignStatus& design = campaign.status.designs[place->second];
  design.state = row.state;
  design.used = row.used;
  design.iteration = row.iteration;
  design.best = row.best.value;
  design.best_mean = row.best_mean;
}

void Telemetry::on_rows(std::size_t index, std::span<const Row> rows, TimePoint now) {
  Campaign& campaign = campaigns_[index];
  for (const Row& row : rows) {
    if (const auto* state = std::get_if<DesignStateRow>(&row)) {
      add_state(campaign, *state);
    } else if (const auto* step = std::get_if<RaceStepRow>(&row)) {
      const auto [last, is_first] = campaign.last_step.try_emplace(step->design.value, now);
      if (!is_first) campaign.status.step_time.observe(now - last->second);
      last->second = now;
      const auto place = campaign.place_of.find(step->design.value);
      if (place != campaign.place_of.end()) {
        campaign.status.designs[place->second].used = step->used;
      }
    }
  }
}

void Telemetry::on_appended(std::size_t campaign, std::uint64_t ticket, TimePoint now) {
  campaigns_[campaign].uncommitted.emplace_back(ticket, now);
}

void Telemetry::on_committed(std::size_t index, std::uint64_t ticket, TimePoint now) {
  Campaign& campaign = campaigns_[index];
  while (!campaign.uncommitted.empty() && campaign.uncommitted.front().first <= ticket) {
    campaign.status.commit_time.observe(now - campaign.uncommitted.front().second);
    campaign.uncommitted.pop_front();
  }
}

void Telemetry::set_wal_bytes(std::size_t campaign, std::int64_t bytes) {
  campaigns_[campaign].status.wal_bytes = bytes;
}

void Telemetry::set_trouble(std::size_t campaign, const std::string& trouble) {
  campaigns_[campaign].status.trouble = trouble;
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
    const std::set<DesignId>& paused = coordinator.paused(static_cast<std::uint32_t>(i));
    for (DesignStatus& design : status.designs)
      design.paused = paused.contains({design.id}) && !is_over(design.state);
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
  for (Campaign& campaign : campaigns_) {
    CampaignStatus& status = campaign.status;
    status.used = 0;
    status.budget = 0;
    for (const DesignStatus& design : status.designs) {
      const bool is_raced = design.state == DesignState::Testing || is_over(design.state);
      status.used += design.used;
      status.budget += is_raced ? design.used : design.budget;
    }
    used += status.used;
  }
  if (all || !lists_ || now - renewed_ >= kRenewEvery) renew_lists(coordinator, now);
  LiveStatus status = coordinator.status();
  status.uptime_s = std::chrono::duration<double>(now - start_).count();
  status.evaluations_per_s = done_.update(now, status.done);
  status.used_per_s = used_.update(now, used);
  status.bytes_in = bytes_in_;
  status.bytes_out = bytes_out_;
  status.fleet = fleet_;
  status.campaigns = lists_;
  return status;
}

}  // namespace swarmsmith
