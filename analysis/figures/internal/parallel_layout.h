#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/drawing/axes.h"
#include "analysis/figures/parallel_plot.h"

namespace swarmsmith {

inline constexpr double kAxisText = 2.3;  ///< size of the labels at the axes
inline constexpr double kAxisTextLine = 2.7;
inline constexpr double kInactivePlace = 7;  ///< width of the place for inactive parameters
inline constexpr std::string_view kScoreName = "mean score";

/// Places and labels of all axes of parallel coordinates, mm. The plot must outlive this object.
class ParallelLayout {
 public:
  struct Label {
    double x = 0;  ///< middle
    std::string text;
    std::size_t line = 0;  ///< line number below the axis
  };

  explicit ParallelLayout(const ParallelPlot& plot);

  double left() const { return left_; }
  double right() const { return right_; }
  double names() const { return names_; }  ///< maximum width of the axes' names
  double inactive_left() const { return inactive_left_; }
  double row(std::size_t parameter) const { return rows_[parameter]; }
  /// The lower end of an axis's labels.
  double label_end(std::size_t parameter) const { return label_ends_[parameter]; }
  double score_row() const { return score_row_; }
  ValueRange scores() const { return scores_; }
  double score_step() const { return tick_step(scores_, kScoreTicks); }
  const std::vector<Label>& labels(std::size_t parameter) const { return labels_[parameter]; }
  double score_at(double mean) const { return Axis(scores_, left_, right_).at(mean); }

  /// `spread` in [-0.5, 0.5] separates lines through the same category.
  double at(std::size_t parameter, double value, double spread) const;

 private:
  static constexpr std::size_t kScoreTicks = 5;

  std::vector<Label> labels_of(const ParallelPlot::Parameter& parameter) const;
  std::vector<Label> number_labels(const ParallelPlot::Parameter& parameter) const;

  const ParallelPlot& plot_;
  double names_ = 0;
  double inactive_left_ = 0;
  double left_ = 0;
  double right_ = 0;
  ValueRange scores_;
  std::vector<double> rows_;
  std::vector<double> label_ends_;
  double score_row_ = 0;
  std::vector<std::vector<Label>> labels_;
};

}  // namespace swarmsmith
