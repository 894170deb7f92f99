#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "coordinator/service/service.h"
#include "proto/socket.h"
#include "storage/store.h"

namespace swarmsmith {

/// The stores of a service's campaigns, in the order of the campaigns, and the news from their
/// writer threads. All members are called from the loop's thread, except the listener that the
/// writer threads call.
class CampaignStores {
 public:
  /// Installs its own listener in each store; `wakeup` is notified whenever a writer reports news.
  CampaignStores(const std::vector<ServiceCampaign>& campaigns, Wakeup& wakeup);
  ~CampaignStores();
  CampaignStores(const CampaignStores&) = delete;
  CampaignStores& operator=(const CampaignStores&) = delete;

  std::size_t count() const { return entries_.size(); }
  const std::string& name(std::size_t campaign) const { return entries_[campaign].name; }

  std::uint64_t append(std::size_t campaign, std::vector<Row> rows);
  /// Flushes the stores that can write. If a disk fills up now, its news is there afterwards.
  void flush();

  /// The latest news of the store's writer, if there is any since the last call.
  std::optional<WriterNews> take_news(std::size_t campaign);
  /// Records the store's current trouble; returns whether it has changed.
  bool update_trouble(std::size_t campaign, const std::string& trouble);
  /// The trouble of the first store that cannot write; empty if all stores can.
  std::string trouble() const;

  /// Marks that the store's file is lost; the store's trouble says what happened to it.
  void set_lost(std::size_t campaign) { entries_[campaign].is_lost = true; }
  bool any_lost() const;
  /// For each store, its trouble if the store is lost; empty for the others.
  std::vector<std::string> lost() const;

  /// Calls `on_bytes` for each store with a file: its index, and the length of its write-ahead log.
  void each_log(const std::function<void(std::size_t, std::int64_t)>& on_bytes) const;

 private:
  struct Entry {
    Store* store = nullptr;
    std::filesystem::path file;
    std::string name;
    std::string trouble;
    bool is_lost = false;
  };

  Wakeup* wakeup_;
  std::vector<Entry> entries_;
  std::mutex mutex_;
  std::vector<std::optional<WriterNews>> news_;  ///< guarded by the mutex
};

}  // namespace swarmsmith
