#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.h"
#include "base/rng.h"
#include "sim/control/behaviours.h"
#include "sim/control/conditions.h"

namespace swarmsmith {

struct Flavour;

/// Limit of the search space (Kuckling et al., ANTS 2018; docs/methods.md).
inline constexpr int kMaxSubtrees = 4;

/// A selector: as long as its condition does not hold, its action acts.
struct Subtree {
  Condition condition;
  Behaviour action;

  friend bool operator==(const Subtree&, const Subtree&) = default;
};

/// The behaviour tree of AutoMoDe-Maple: a sequence with memory of one to four selectors. Action i
/// acts until condition i holds, then subtree i + 1 is next; after the last subtree comes the
/// first.
struct Tree {
  std::vector<Subtree> subtrees;

  friend bool operator==(const Tree&, const Tree&) = default;
};

/// The error in the tree, if there is one; `where` names the subtree.
std::optional<Error> check(const Tree& tree, const Flavour& flavour);

/// Reads the text of a tree in the format of AutoMoDe-Maple's programs:
///
///     --nroot 3 --nchildroot 1 --n0 0 --nchild0 2 --n00 6 --c00 0 --p00 1 --n01 5 --a01 1 --p01 0
///
/// The numbers of modules are the numbers in the flavour's tables. A leading `--bt-config` is
/// skipped. Only Maple's trees are accepted: any other kind of node is an error. `where` is as in
/// parse_machine.
Expected<Tree> parse_tree(std::string_view text, const Flavour& flavour);

/// The canonical text. Throws std::invalid_argument when the tree does not fit the flavour.
std::string print_tree(const Tree& tree, const Flavour& flavour);

/// A running tree. A tick starts at the subtree that acted last. A condition that holds, with its
/// probability, ends its subtree, and the next one is ticked in the same cycle; when the last one
/// ends, the robot stands still in that cycle. Actions keep their memory between ticks: Exploration
/// continues an interrupted turn (AutoMoDe-private, branch BehaviorTree @ dd7167c;
/// docs/methods.md).
class TreeControl {
 public:
  /// `tree` and `flavour` must outlive the object.
  TreeControl(const Tree& tree, const Flavour& flavour, Rng rng);

  Command step(Senses& senses);

  /// Index of the subtree that is ticked first in the next cycle.
  int state() const { return subtree_; }
  std::uint64_t drawn() const { return rng_.drawn(); }

 private:
  const Tree* tree_;
  const Flavour* flavour_;
  Rng rng_;
  int subtree_ = 0;
  std::vector<BehaviourMemory> memories_;  ///< by subtree
};

}  // namespace swarmsmith
