#pragma once

#include <memory>
#include <vector>

#include "irace_core/search/search_parts.h"
#include "irace_core/search/strategy.h"

namespace swarmsmith::search {

/// How a search by generations spends its budget.
struct GenerationPlan {
  std::int64_t generations = 0;
  std::int64_t population = 0;  ///< of each generation; the last one of random search is smaller
  std::int64_t configurations = 0;  ///< of all generations together
  std::int64_t runs = 0;            ///< of each member, on pairs that its generation shares
  bool fresh_pairs = true;          ///< each generation has pairs of its own
  std::int64_t finalists = 0;       ///< that the final stage runs again
  std::int64_t final_runs = 0;      ///< of each of them, on fresh pairs

  /// Where all share their pairs, generations are but parts of one: the last may be smaller.
  bool may_be_cut() const { return !fresh_pairs; }
};

/// Who is in a generation: those that are known, by their ids, and new ones.
struct Brood {
  std::vector<std::int64_t> known;
  std::vector<Newcomer> newcomers;
};

/// What differs between searches by generations.
class Breeder {
 public:
  virtual ~Breeder() = default;
  /// Generation `generation`, from 1, of `size` members; `last` is the one before, best first, and
  /// empty for the first. The first newcomer gets the id `next_id`.
  virtual Expected<Brood> breed(std::int64_t generation, std::int64_t size, std::int64_t next_id,
                                std::span<const Scored> last) = 0;
  /// Who takes part in the final stage; `last` as above.
  virtual Expected<Brood> finalists(std::int64_t count, std::int64_t next_id,
                                    std::span<const Scored> last) = 0;
  /// The elites after a generation, best first; it is given best first.
  virtual std::vector<Scored> elites(std::span<const Scored> generation) = 0;
  virtual void add_to(Digest& digest) const = 0;
};

/// Generations of one size on common pairs, then a final stage, whose best mean wins: what a
/// generation says of its best is too good, the more so the larger it is.
class Generations final : public Strategy {
 public:
  Generations(GenerationPlan plan, std::unique_ptr<Breeder> breeder)
      : plan_(plan), breeder_(std::move(breeder)) {}

  Expected<std::optional<Round>> next(std::int64_t next_id) override;
  Verdict take(std::span<const double> costs) override;
  std::int64_t planned_iterations() const override {
    return iterations_before_ + plan_.generations + 1;
  }
  Expected<void> extend(std::int64_t experiments) override;
  Expected<std::int64_t> least_extension() const override;
  void add_to(Digest& digest) const override;

 private:
  bool is_final() const { return generation_ > plan_.generations; }

  GenerationPlan plan_;
  std::unique_ptr<Breeder> breeder_;
  std::int64_t generation_ = 0;         ///< of the plan; one more is the final stage
  std::int64_t iterations_before_ = 0;  ///< of plans that are over
  std::int64_t generation_number_ = 0;  ///< through all plans, final stages left out
  std::int64_t bred_ = 0;               ///< configurations of the plan so far
  std::int64_t next_pair_ = 1;          ///< that no candidate has seen
  bool over_ = false;
  std::vector<std::pair<std::int64_t, std::int64_t>> runs_;
  std::vector<Scored> last_;  ///< of the last generation, the final stage left out
  std::vector<std::int64_t> elites_;
};

/// Generations of `population` x `runs` in a budget, each with a final stage of all its members.
/// `final_runs` 0: as published for EvoStick, 20 for 10,000, 100 for 50,000 and 100,000, 500 for
/// 200,000 (ARGoS3-NEAT, params/; docs/methods.md). The rest goes to the final stage.
Expected<GenerationPlan> plan_generations(std::int64_t budget, std::int64_t population,
                                          std::int64_t runs, std::int64_t final_runs);

/// The point as the plan has it; as it is when there is none.
SearchPoint planned_by(const Expected<GenerationPlan>& plan, SearchPoint point);

}  // namespace swarmsmith::search
