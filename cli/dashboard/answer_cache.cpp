#include "cli/dashboard/answer_cache.h"

#include <iterator>
#include <utility>

namespace swarmsmith::cli {

AnswerCache::Answer AnswerCache::get(const std::string& question, const std::string& stamp,
                                     std::chrono::milliseconds fresh,
                                     const std::function<KeptAnswer()>& make, bool& shared) {
  shared = true;
  std::promise<Answer> promise;
  std::uint64_t forgotten = 0;
  {
    std::unique_lock lock(mutex_);
    if (const auto found = kept_.find(question); found != kept_.end()) {
      const Kept& kept = *found->second;
      const bool same = !stamp.empty() && kept.stamp == stamp;
      if (kept.answer->is_final || same || Clock::now() - kept.when < fresh) {
        order_.splice(order_.begin(), order_, found->second);
        return kept.answer;
      }
    }
    if (const auto found = under_way_.find(question); found != under_way_.end()) {
      const std::shared_future<Answer> answer = found->second;
      lock.unlock();
      return answer.get();
    }
    under_way_.emplace(question, promise.get_future().share());
    forgotten = forgotten_;
  }
  shared = false;
  const auto when = Clock::now();
  const auto answer = std::make_shared<const KeptAnswer>(make());
  {
    const std::scoped_lock lock(mutex_);
    under_way_.erase(question);
    if (answer->is_good && forgotten == forgotten_) keep(question, stamp, when, answer);
  }
  promise.set_value(answer);
  return answer;
}

void AnswerCache::keep(const std::string& question, const std::string& stamp,
                       Clock::time_point when, const Answer& answer) {
  if (const auto old = kept_.find(question); old != kept_.end()) {
    bytes_ -= weight(*old->second);
    order_.erase(old->second);
    kept_.erase(old);
  }
  order_.push_front({question, stamp, when, answer});
  kept_[question] = order_.begin();
  bytes_ += weight(order_.front());
  while (bytes_ > most_bytes_) {
    bytes_ -= weight(order_.back());
    kept_.erase(order_.back().question);
    order_.pop_back();
  }
}

std::size_t AnswerCache::weight(const Kept& kept) {
  constexpr std::size_t kOverhead = 500;
  return kOverhead + 2 * kept.question.size() + kept.stamp.size() + kept.answer->packed.size();
}

void AnswerCache::forget() {
  const std::scoped_lock lock(mutex_);
  ++forgotten_;
  for (auto at = order_.begin(); at != order_.end();) {
    if (at->answer->is_final) {
      ++at;
      continue;
    }
    bytes_ -= weight(*at);
    kept_.erase(at->question);
    at = order_.erase(at);
  }
}

std::optional<Turnstile::Pass> Turnstile::enter() {
  std::unique_lock lock(mutex_);
  if (inside_ >= at_a_time_) {
    if (waiting_ >= most_waiting_) return std::nullopt;
    ++waiting_;
    left_.wait(lock, [&] { return inside_ < at_a_time_; });
    --waiting_;
  }
  ++inside_;
  return std::optional<Pass>(std::in_place, *this);
}

int Turnstile::waiting() {
  const std::scoped_lock lock(mutex_);
  return waiting_;
}

Turnstile::Pass::~Pass() {
  if (turnstile_ == nullptr) return;
  {
    const std::scoped_lock lock(turnstile_->mutex_);
    --turnstile_->inside_;
  }
  turnstile_->left_.notify_one();
}

}  // namespace swarmsmith::cli
