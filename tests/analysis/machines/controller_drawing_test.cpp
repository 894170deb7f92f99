#include "analysis/machines/controller_drawing.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "analysis/machines/tree_layout.h"
#include "sim/control/tree.h"
#include "tests/analysis/machines/machines_to_draw.h"
#include "tests/analysis/support/svg_texts.h"
#include "tests/support/checks.h"
#include "tests/support/not_empty.h"

namespace swarmsmith {
namespace {

constexpr double kWidths[] = {60, 84, 110, 174};

/// Explores until black, then gathers until three are near.
Tree small_tree() {
  return {{{BlackFloor{0.96}, Exploration{42}}, {NeighbourCount{6.2, 3}, Attraction{2.5}}}};
}

/// Four subtrees of the longest names.
Tree widest_tree() {
  return {{{InvertedNeighbourCount{19.66, 10}, Exploration{100}},
           {ColorDetection{0.45, ColorLabel::Yellow}, Attraction{4.97}},
           {FixedProbability{0.96}, Repulsion{4.97}},
           {InvertedNeighbourCount{19.66, 10}, Exploration{100}}}};
}

Tree random_tree(Rng& rng) {
  Tree tree;
  const auto count = rng.uniform_int(1, kMaxSubtrees);
  for (int i = 0; i < count; ++i)
    tree.subtrees.push_back({random_condition(rng), random_behaviour(rng)});
  return tree;
}

/// -5, -4.5, ... in turn.
Network network_of(NetworkInputs inputs) {
  Network network{.inputs = inputs, .weights = {}};
  for (std::size_t i = 0; i < kWheels * input_count(inputs); ++i)
    network.weights.push_back(static_cast<double>(i % 21) / 2 - 5);
  return network;
}

std::string svg_of(const Controller& controller, double width) {
  return drawing_of(controller, watermelon(), width, "d1 c7").svg.finish();
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

/// Boxes around shapes, mm.
struct Box {
  PagePoint centre;
  double width = 0;
  double height = 0;
};

bool overlap(const Box& a, const Box& b) {
  return std::abs(a.centre.x - b.centre.x) < (a.width + b.width) / 2 &&
         std::abs(a.centre.y - b.centre.y) < (a.height + b.height) / 2;
}

std::vector<Box> shapes_of(const TreeLayout& layout) {
  std::vector<Box> boxes = {{layout.root, layout.node_side, layout.node_side}};
  for (const SubtreeShape& shape : layout.subtrees) {
    boxes.push_back({shape.selector, layout.node_side, layout.node_side});
    for (const LeafShape& leaf : {shape.condition, shape.action})
      boxes.push_back({leaf.centre, leaf.width, leaf.height});
  }
  return boxes;
}

/// Whether the line, but for its ends, comes into the box.
bool meets(const std::vector<PagePoint>& line, const Box& box) {
  for (std::size_t i = 1; i < line.size(); ++i) {
    for (int j = 1; j < 50; ++j) {
      const double part = j / 50.0;
      const PagePoint at{line[i - 1].x + part * (line[i].x - line[i - 1].x),
                         line[i - 1].y + part * (line[i].y - line[i - 1].y)};
      if (overlap({at, 0, 0}, box)) return true;
    }
  }
  return false;
}

void expect_readable(const Tree& tree, double width) {
  SCOPED_TRACE(print_tree(tree, watermelon()) + " at " + std::to_string(width));
  const TreeLayout layout = lay_out(tree, watermelon(), width);
  const std::string svg = svg_of(tree, width);
  EXPECT_THAT(text_problems(svg), IsEmpty());
  EXPECT_THAT(shape_problems(svg), IsEmpty());
  ASSERT_EQ(layout.subtrees.size(), tree.subtrees.size());
  const std::vector<Box> boxes = shapes_of(layout);
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_FALSE(overlap(boxes[a], boxes[b])) << "shapes " << a << " and " << b;
  for (const SubtreeShape& shape : layout.subtrees) {
    for (const SubtreeShape& other : layout.subtrees) {
      const LeafShape& box = other.condition;
      EXPECT_FALSE(meets(shape.to_action, {box.centre, box.width, box.height}));
    }
  }
}

TEST(TreeLayout, OfRandomTreesIsReadable) {
  Rng rng(7);
  for (int i = 0; i < 200; ++i) {
    const Tree tree = random_tree(rng);
    for (const double width : kWidths)
      expect_readable(tree, width);
  }
}

TEST(TreeLayout, OfTheLongestNamesIsReadable) {
  for (const double width : kWidths)
    expect_readable(widest_tree(), width);
}

TEST(TreeLayout, GoesFromTopToBottomAndFromLeftToRight) {
  const TreeLayout layout = lay_out(widest_tree(), watermelon(), 174);
  double left = 0;
  for (const SubtreeShape& shape : not_empty(layout.subtrees)) {
    EXPECT_GT(shape.selector.y, layout.root.y + layout.node_side);
    EXPECT_GT(shape.condition.centre.y, shape.selector.y + layout.node_side);
    EXPECT_GE(shape.action.centre.y, shape.condition.centre.y);
    EXPECT_GT(shape.selector.x, left);
    left = shape.selector.x;
  }
}

TEST(TreeLayout, PutsActionsBesideTheirConditionsWhereThereIsRoom) {
  const auto first = [](const Tree& tree, double width) {
    return lay_out(tree, watermelon(), width).subtrees.front();
  };
  const SubtreeShape beside = first(small_tree(), 84);
  EXPECT_EQ(beside.action.centre.y, beside.condition.centre.y);
  const SubtreeShape below = first(widest_tree(), 84);
  EXPECT_GT(below.action.centre.y, below.condition.centre.y + below.condition.height / 2);
}

TEST(TreeLayout, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(lay_out(Tree{}, watermelon(), 84), std::invalid_argument);
  EXPECT_THROW(lay_out(small_tree(), watermelon(), 59), std::invalid_argument);
  EXPECT_THROW(lay_out(Tree{{{BlackFloor{}, Phototaxis{}}}}, watermelon(), 84),
               std::invalid_argument);
}

TEST(TreeDrawing, HasTheSignsAndTheNamesWithTheirParameters) {
  const ControllerDrawing drawing = drawing_of(small_tree(), watermelon(), 84, "d1 c7");
  const std::string svg = drawing.svg.finish();
  for (const char* word : {"<title>d1 c7</title>", ">→*<", ">Black floor<", ">β = 0.96<",
                           ">Exploration<", ">τ = 42<", ">Neighbour count<", ">ξ = 3, η = 6.2<"})
    EXPECT_THAT(svg, HasSubstr(word));
  EXPECT_EQ(occurrences(svg, ">?<"), 2U);
  EXPECT_EQ(occurrences(svg, "<circle"), 2U);
}

TEST(TreeDrawing, NamesEachActionAsAPartForPagesThatLightItUp) {
  const std::string svg = drawing_of(small_tree(), watermelon(), 84, "").svg.finish();
  EXPECT_EQ(occurrences(svg, "<g data-state="), 2U);
  EXPECT_EQ(occurrences(svg, "</g>"), 2U);
  const std::string last = svg.substr(svg.find("<g data-state=\"1\">"));
  const std::string part = last.substr(0, last.find("</g>"));
  EXPECT_EQ(occurrences(part, "<circle"), 1U);
  EXPECT_EQ(occurrences(part, "<path"), 0U);
}

TEST(TreeDrawing, IsTextOfGraphviz) {
  EXPECT_EQ(drawing_of(Tree{{{BlackFloor{0.5}, Stop{}}}}, watermelon(), 84, "d1 c7").dot,
            "digraph \"d1 c7\" {\n"
            "  ordering=out;\n"
            "  node [fontname=\"Helvetica\", fontsize=10];\n"
            "  edge [arrowhead=none];\n"
            "  root [shape=square, label=\"→*\"];\n"
            "  s0 [shape=square, color=\"#0072b2\", label=\"?\"];\n"
            "  c0 [shape=hexagon, margin=0, color=\"#0072b2\", label=\"Black floor\\nβ = 0.5\"];\n"
            "  a0 [shape=circle, style=filled, color=\"#0072b2\", fillcolor=\"#e0eef6\", "
            "label=\"Stop\"];\n"
            "  root -> s0;\n"
            "  s0 -> c0 [color=\"#0072b2\"];\n"
            "  s0 -> a0 [color=\"#0072b2\"];\n"
            "}\n");
}

TEST(NetworkDrawing, OfAllInputsIsReadableAtAllWidths) {
  for (const NetworkInputs inputs :
       {NetworkInputs::Rvr, NetworkInputs::RvrGray, NetworkInputs::Rm12}) {
    for (const double width : kWidths) {
      Network network = network_of(inputs);
      EXPECT_THAT(text_problems(svg_of(network, width)), IsEmpty()) << width;
      EXPECT_THAT(shape_problems(svg_of(network, width)), IsEmpty()) << width;
      network.weights[0] = -1234.5;
      EXPECT_THAT(text_problems(svg_of(network, width)), IsEmpty()) << width;
    }
  }
}

TEST(NetworkDrawing, HasARowForEachInputAndAColumnForEachWheel) {
  const std::string svg = svg_of(network_of(NetworkInputs::Rvr), 84);
  std::vector<std::string> texts;
  for (const TextBox& box : texts_of(svg))
    texts.push_back(box.text);
  EXPECT_THAT(texts, testing::IsSupersetOf({"left", "right", "obstacle 45°", "floor blue",
                                            "neighbour count", "bias", "-5.00", "0.50"}));
  EXPECT_EQ(std::ranges::count(texts, "wheel"), 2);
  const std::regex cell("-?[0-9]\\.[0-9]{2}");
  EXPECT_EQ(std::ranges::count_if(
                texts, [&](const std::string& text) { return std::regex_match(text, cell); }),
            26);
}

TEST(NetworkDrawing, HasWhiteForNothingAndAScaleThatIsTheSameOnBothSides) {
  Network network{.inputs = NetworkInputs::RvrGray, .weights = std::vector<double>(22, 0.0)};
  const std::string nothing = svg_of(network, 84);
  network.weights[3] = 5;
  network.weights[4] = -5;
  const std::string both = svg_of(network, 84);
  EXPECT_EQ(occurrences(both, "#0072b2"), occurrences(nothing, "#0072b2") + 1);
  EXPECT_EQ(occurrences(both, "#d55e00"), occurrences(nothing, "#d55e00") + 1);
  for (const char* tick : {">-4<", ">0<", ">4<"})
    EXPECT_THAT(nothing, HasSubstr(tick));
  network.weights[4] = -37;
  for (const char* tick : {">-40<", ">40<"})
    EXPECT_THAT(svg_of(network, 84), HasSubstr(tick));
}

TEST(NetworkDrawing, IsTextOfGraphviz) {
  const std::string dot =
      drawing_of(network_of(NetworkInputs::RvrGray), watermelon(), 84, "d1 c7").dot;
  EXPECT_THAT(dot, HasSubstr("  i0 [shape=box, label=\"obstacle 45°\"];\n"
                             "  i0 -> w0 [label=\"-5.00\", color=\"#d55e00\", penwidth=3.30];\n"));
  EXPECT_EQ(occurrences(dot, " -> "), 22U);
}

TEST(ControllerDrawing, CanStandInAPageWithOthers) {
  for (const Controller& controller :
       {Controller(small_tree()), Controller(network_of(NetworkInputs::Rvr))}) {
    for (const char* word : {" id=", "marker", "<style", "url(", "<defs"})
      EXPECT_THAT(svg_of(controller, 84), Not(HasSubstr(word)));
  }
}

/// What a line of our pictures may be: commands of TikZ itself, with numbers, colours, and the
/// letters of TeX for ours.
bool is_tikz_line(const std::string& line) {
  const std::string number = R"(-?[0-9]+(\.[0-9]+)?)";
  const std::string point = "\\(" + number + "," + number + "\\)";
  const std::string color = R"(\{rgb,255:red,[0-9]+;green,[0-9]+;blue,[0-9]+\})";
  const std::string dashes = "(,dash pattern=(on " + number + "mm off " + number + "mm ?)+)?";
  const std::string paint =
      "\\[((draw|fill)=" + color + ",)+line width=" + number + "mm" + dashes + "\\]";
  const std::string text =
      R"(([A-Za-z0-9 =.,:;()?*+-]|\$\\(tau|alpha|beta|xi|eta|rightarrow)\$|\$\^\\circ\$)+)";
  const std::string points = point + "( -- " + point + ")+";
  const std::regex form(
      R"(\\begin\{tikzpicture\}\[x=1mm,y=-1mm\]|\\end\{tikzpicture\}|)"
      R"(\\useasboundingbox )" +
      point + " rectangle " + point + ";|\\\\draw" + paint + " " + points + ";|\\\\path" + paint +
      " " + points + " -- cycle;|\\\\path" + paint + " " + point + " circle\\[radius=" + number +
      R"(mm\];|\\node\[anchor=base( east| west)?,inner sep=0pt,outer sep=0pt,scale=)" + number +
      "(,text=" + color + R"()?,font=\\sffamily\\fontsize\{10\}\{12\}\\selectfont\] at )" + point +
      " \\{" + text + "\\};");
  return std::regex_match(line, form);
}

TEST(ControllerDrawing, HoldsNothingButPlainTikz) {
  for (const Controller& controller :
       {Controller(small_tree()), Controller(widest_tree()),
        Controller(network_of(NetworkInputs::Rvr)), Controller(network_of(NetworkInputs::Rm12))}) {
    std::istringstream lines(drawing_of(controller, watermelon(), 84, "").tikz);
    std::string line;
    while (std::getline(lines, line))
      EXPECT_TRUE(is_tikz_line(line)) << line;
  }
}

}  // namespace
}  // namespace swarmsmith
