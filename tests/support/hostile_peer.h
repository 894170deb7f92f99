#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/rng.h"
#include "proto/wire.pb.h"
#include "tests/support/truth.h"

namespace swarmsmith::cluster {

/// What a hostile peer is after. All of its messages are well formed.
enum class Misdeed {
  Lies,              ///< plausible scores for what it was leased
  LiesLater,         ///< the same, once it has answered rightly for a while
  Rejects,           ///< says of what it was leased that it is to be rejected
  Fails,             ///< says that it has no score for what it was leased
  Guesses,           ///< scores, rejections and failures for keys that it was never leased
  Replays,           ///< what it and honest workers said, on its own connection
  Floods,            ///< a hundred messages at a time
  Renames,           ///< lies, and comes back under another id after a few
  LeavesWithLeases,  ///< hangs up as soon as it has any
  LeavesAlone,       ///< hangs up when it has one task alone, as suspects have; gives back others
  ClaimsLeases,      ///< claims to hold what it does not, and answers it
  TalksNonsense,     ///< heartbeats, credit, returns of others' tasks and of its own, endless times
  TalksAtRandom,     ///< any messages in any order
};

inline constexpr std::array kMisdeeds = {
    Misdeed::Lies,         Misdeed::LiesLater,    Misdeed::Rejects,
    Misdeed::Fails,        Misdeed::Guesses,      Misdeed::Replays,
    Misdeed::Floods,       Misdeed::Renames,      Misdeed::LeavesWithLeases,
    Misdeed::LeavesAlone,  Misdeed::ClaimsLeases, Misdeed::TalksNonsense,
    Misdeed::TalksAtRandom};

const char* name_of(Misdeed misdeed);

/// What an evaluation really gives.
using Oracle = std::function<Truth(const pb::Task&)>;

/// One peer that is not a worker: frames in, frames and hang-ups out, all by its stream of random
/// numbers. It knows the protocol, and how an honest worker introduces itself.
class HostilePeer {
 public:
  /// Without an oracle it never tells the truth.
  HostilePeer(Misdeed misdeed, Rng rng, Oracle oracle = {});

  Misdeed misdeed() const { return misdeed_; }
  /// What an honest worker said: it is imitated, and may be said again.
  void overhear(const std::string& frame);
  /// On a new connection, once it has heard how one introduces oneself.
  void on_connected();
  void on_frame(std::string_view frame);
  /// Every few milliseconds.
  void on_tick();

  std::vector<std::string> take_frames() { return std::exchange(frames_, {}); }
  /// Whether it wants to hang up now.
  bool take_hang_up() { return std::exchange(hangs_up_, false); }
  bool knows_the_words() const { return hello_.slots() > 0; }
  /// How often it did what it is after.
  std::uint64_t acts() const { return acts_; }

 private:
  void say(pb::ToCoordinator message);
  void say_hello(bool with_claims = false);
  void say_credit(std::uint32_t tasks);
  void on_tasks(const pb::Tasks& tasks);
  void answer(const pb::Tasks& tasks);
  /// A result for the task, with what its lease says.
  pb::Result result_of(const pb::Task& task);
  bool is_honest_now();
  void lie(pb::Result& result);
  pb::Key guess();
  void guess_results();
  void replay();
  void give_back(const pb::Tasks& tasks);
  void talk_nonsense();
  void talk_at_random();
  void say_began(const pb::Task& task);
  void hang_up();

  Misdeed misdeed_;
  Rng rng_;
  Oracle oracle_;
  pb::Hello hello_;
  std::uint64_t scenario_ = 0;
  std::uint64_t incarnation_ = 0;
  std::uint64_t sequence_ = 0;
  std::uint64_t acts_ = 0;
  int answered_ = 0;  ///< under this id
  int truths_ = 0;
  std::deque<pb::Task> held_;
  std::deque<std::string> overheard_;
  std::deque<std::string> said_;
  std::vector<std::string> frames_;
  bool hangs_up_ = false;
};

}  // namespace swarmsmith::cluster
