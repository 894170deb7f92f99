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

/// The stores of a service's campaigns, in the campaigns' order, and what their writers' threads
/// say, for the loop's thread: every member but the listener is called from there.
class CampaignStores {
 public:
  /// Takes the stores' listeners over; `wakeup` is notified of whatever they say.
  CampaignStores(const std::vector<ServiceCampaign>& campaigns, Wakeup& wakeup);
  ~CampaignStores();
  CampaignStores(const CampaignStores&) = delete;
  CampaignStores& operator=(const CampaignStores&) = delete;

  std::size_t count() const { return entries_.size(); }
  const std::string& name(std::size_t campaign) const { return entries_[campaign].name; }

  std::uint64_t append(std::size_t campaign, std::vector<Row> rows);
  /// Those that can write; the others would wait for ever.
  void flush();

  /// What a writer has said last, once.
  std::optional<WriterNews> take_news(std::size_t campaign);
  /// Whether the store's trouble is another than before.
  bool update_trouble(std::size_t campaign, const std::string& trouble);
  /// Of the first store that cannot write; empty when all can.
  std::string trouble() const;

  /// The file of a store is lost; its trouble says how.
  void set_lost(std::size_t campaign) { entries_[campaign].is_lost = true; }
  bool any_lost() const;
  /// Of each store, the trouble of one that is lost; empty for the others.
  std::vector<std::string> lost() const;

  /// The length of a store's write-ahead log, for each that has a file.
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
  std::vector<std::optional<WriterNews>> news_;  ///< under the mutex
};

}  // namespace swarmsmith
