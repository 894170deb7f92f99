#include "coordinator/service/campaign_stores.h"

#include <algorithm>
#include <utility>

namespace swarmsmith {

CampaignStores::CampaignStores(const std::vector<ServiceCampaign>& campaigns, Wakeup& wakeup)
    : wakeup_(&wakeup), news_(campaigns.size()) {
  for (const ServiceCampaign& campaign : campaigns) {
    const std::size_t index = entries_.size();
    entries_.push_back({campaign.store, campaign.file, campaign.name, "", false});
    campaign.store->set_listener([this, index](const WriterNews& news) {
      {
        const std::scoped_lock lock(mutex_);
        news_[index] = news;
      }
      wakeup_->notify();
    });
  }
}

CampaignStores::~CampaignStores() {
  for (const Entry& entry : entries_)
    entry.store->set_listener({});
}

std::uint64_t CampaignStores::append(std::size_t campaign, std::vector<Row> rows) {
  return entries_[campaign].store->append(std::move(rows));
}

void CampaignStores::flush() {
  for (const Entry& entry : entries_)
    if (entry.trouble.empty()) entry.store->flush();
}

std::optional<WriterNews> CampaignStores::take_news(std::size_t campaign) {
  const std::scoped_lock lock(mutex_);
  return std::exchange(news_[campaign], std::nullopt);
}

bool CampaignStores::update_trouble(std::size_t campaign, const std::string& trouble) {
  return std::exchange(entries_[campaign].trouble, trouble) != trouble;
}

std::string CampaignStores::trouble() const {
  const auto some =
      std::ranges::find_if(entries_, [](const Entry& entry) { return !entry.trouble.empty(); });
  return some == entries_.end() ? std::string() : some->trouble;
}

bool CampaignStores::any_lost() const {
  return std::ranges::any_of(entries_, &Entry::is_lost);
}

std::vector<std::string> CampaignStores::lost() const {
  std::vector<std::string> lost;
  for (const Entry& entry : entries_)
    lost.push_back(entry.is_lost ? entry.trouble : "");
  return lost;
}

void CampaignStores::each_log(
    const std::function<void(std::size_t, std::int64_t)>& on_bytes) const {
  for (std::size_t index = 0; index < entries_.size(); ++index) {
    if (entries_[index].file.empty()) continue;
    std::error_code none;
    const auto bytes = std::filesystem::file_size(entries_[index].file.string() + "-wal", none);
    on_bytes(index, none ? 0 : static_cast<std::int64_t>(bytes));
  }
}

}  // namespace swarmsmith
