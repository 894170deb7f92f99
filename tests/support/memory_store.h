#pragma once

#include <string>
#include <vector>

#include "storage/store.h"

namespace swarmsmith {

/// A store that forgets everything with the process. Commits at once, unless it is in trouble.
class MemoryStore final : public Store {
 public:
  std::uint64_t append(std::vector<Row> rows) override {
    for (Row& row : rows)
      all.push_back(std::move(row));
    ++appended_;
    if (trouble_.empty()) tell();
    return appended_;
  }
  void set_listener(std::function<void(const WriterNews&)> on_news) override {
    on_news_ = std::move(on_news);
  }
  Expected<void> flush() override {
    tell();
    return {};
  }
  std::vector<StoredScore> scores() override { return known; }
  std::vector<StoredStep> steps() override { return {}; }
  std::vector<DesignStateRow> design_states() override { return {}; }
  std::vector<CommandRow> commands() override { return rows_of<CommandRow>(); }
  std::int64_t next_worker() override { return 1; }
  bool finished() override { return false; }

  /// The disk is full, or has room again when empty.
  void set_trouble(std::string trouble) {
    trouble_ = std::move(trouble);
    tell();
  }
  template <class Kind>
  std::vector<Kind> rows_of() const {
    std::vector<Kind> found;
    for (const Row& row : all) {
      if (const auto* one = std::get_if<Kind>(&row)) found.push_back(*one);
    }
    return found;
  }

  std::vector<Row> all;
  std::vector<StoredScore> known;

 private:
  void tell() {
    if (trouble_.empty()) committed_ = appended_;
    if (on_news_) on_news_({committed_, trouble_});
  }

  std::function<void(const WriterNews&)> on_news_;
  std::string trouble_;
  std::uint64_t appended_ = 0;
  std::uint64_t committed_ = 0;
};

}  // namespace swarmsmith
