#pragma once

#include <vector>

#include "analysis/machines/machine_layout.h"

namespace swarmsmith {

struct Tree;

/// Positions of all parts of a drawn behaviour tree: the root at the top, below it a selector for
/// each subtree, and below each selector its condition in a pointed box and its action in a circle,
/// as in pictures of machines. Lengths are mm.

/// A condition's box including its points, or an action's circle, whose width is its height.
struct LeafShape {
  PagePoint centre;
  double width = 0;
  double height = 0;
  std::vector<LabelLine> lines;
};

struct SubtreeShape {
  PagePoint selector;  ///< centre of its square
  LeafShape condition;
  LeafShape action;
  /// Lines between the nodes.
  std::vector<PagePoint> to_selector;
  std::vector<PagePoint> to_condition;
  std::vector<PagePoint> to_action;
};

struct TreeLayout {
  double width = 0;
  double height = 0;
  double node_side = 0;  ///< side of the squares of root and selectors
  double sign_size = 0;  ///< size of the letters in the squares
  PagePoint root;
  std::vector<SubtreeShape> subtrees;  ///< from left to right, in the order of the tree
};

/// Condition and action are side by side if all of them fit on the page, else the action is below
/// its condition; if that is too wide, too, letters are made smaller. The height follows from the
/// width. A pure function.
///
/// Throws std::invalid_argument if the tree has no subtree, a module does not belong to the
/// flavour, or the page is narrower than `kNarrowestMachine_mm`.
TreeLayout lay_out(const Tree& tree, const Flavour& flavour, double width_mm);

}  // namespace swarmsmith
