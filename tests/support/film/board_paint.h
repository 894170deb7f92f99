#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>

#include "tests/support/film/lens_map.h"
#include "tests/support/film/scene.h"

namespace swarmsmith::film {

/// Paints a board over a picture; `light_at` says the light of a column.
void paint_board(const FilmedBoard& board, const LensMap& lens,
                 const std::function<float(int)>& light_at, cv::Mat& image);

}  // namespace swarmsmith::film
