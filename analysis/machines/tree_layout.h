#pragma once

#include <vector>

#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

struct Tree;

/// Where everything of a drawn behaviour tree stands on the page: the root above, a selector below
/// it for each subtree, and below each selector its condition in a pointed box and its action in a
/// circle, as in pictures of machines. Lengths are mm.

/// A condition's box, with its points, or an action's circle, as wide as it is high.
struct LeafShape {
  PagePoint centre;
  double width = 0;
  double height = 0;
  std::vector<LabelLine> lines;
};

struct SubtreeShape {
  PagePoint selector;  ///< middle of its square
  LeafShape condition;
  LeafShape action;
  /// From node to node.
  std::vector<PagePoint> to_selector;
  std::vector<PagePoint> to_condition;
  std::vector<PagePoint> to_action;
};

struct TreeLayout {
  double width = 0;
  double height = 0;
  double node_side = 0;  ///< of the squares of root and selectors
  double sign_size = 0;  ///< of the letters in them
  PagePoint root;
  std::vector<SubtreeShape> subtrees;  ///< from left to right, in the tree's order
};

/// Condition and action stand side by side where all of them fit into the page, else the action
/// below its condition; where that is too wide, too, letters get smaller. The height follows. A
/// pure function.
///
/// Throws std::invalid_argument when the tree has no subtree, a module is none of the flavour's, or
/// the page is narrower than `kNarrowestMachine_mm`.
TreeLayout lay_out(const Tree& tree, const Flavour& flavour, double width_mm);

}  // namespace swarmsmith
