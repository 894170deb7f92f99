#include "tests/support/film/board_paint.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/film/cell_picture.h"
#include "tests/support/film/paint.h"

namespace swarmsmith::film {
namespace {

struct OnBoard {
  double column, row;  ///< pixels of the board's picture
};

OnBoard on_board(const FilmedBoard& board, const Ray& ray) {
  const auto& r = board.rotation;
  const Point3& t = board.translation;
  const double s = (r[2] * t.x + r[5] * t.y + r[8] * t.z) / (r[2] * ray.x + r[5] * ray.y + r[8]);
  const Point3 p{s * ray.x - t.x, s * ray.y - t.y, s - t.z};
  return {(r[0] * p.x + r[3] * p.y + r[6] * p.z) / board.pixel_m + board.margin_px,
          (r[1] * p.x + r[4] * p.y + r[7] * p.z) / board.pixel_m + board.margin_px};
}

}  // namespace

void paint_board(const FilmedBoard& board, const LensMap& lens,
                 const std::function<float(int)>& light_at, cv::Mat& image) {
  const CellPicture picture{board.width, board.height, 0, board.gray};
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const OnBoard here = on_board(board, lens.at(u, v));
      const OnBoard right = on_board(board, lens.at(u + 1 < image.cols ? u + 1 : u - 1, v));
      const OnBoard below = on_board(board, lens.at(u, v + 1 < image.rows ? v + 1 : v - 1));
      const double turn_u = u + 1 < image.cols ? 1 : -1;
      const double turn_v = v + 1 < image.rows ? 1 : -1;
      const OnBoard by_u{turn_u * (right.column - here.column), turn_u * (right.row - here.row)};
      const OnBoard by_v{turn_v * (below.column - here.column), turn_v * (below.row - here.row)};
      const double reach =
          std::abs(by_u.column) + std::abs(by_u.row) + std::abs(by_v.column) + std::abs(by_v.row);
      if (here.column < -reach || here.row < -reach || here.column > board.width + reach ||
          here.row > board.height + reach)
        continue;
      const float light = light_at(u);
      const float opening =
          std::clamp(static_cast<float>(std::hypot(by_u.column, by_u.row)) / kFine, 0.01F, 1.0F);
      cv::Vec3b& pixel = image.at<cv::Vec3b>(v, u);
      std::array<float, 3> sum{};
      for (int i = 0; i < kSamples; ++i) {
        const double du = (i % kFine + 0.5) / kFine - 0.5;
        const double dv = (i / kFine + 0.5) / kFine - 0.5;
        const double column = here.column + du * by_u.column + dv * by_v.column;
        const double row = here.row + du * by_u.row + dv * by_v.row;
        const bool covered =
            column >= 0 && row >= 0 && column <= board.width && row <= board.height;
        const float printed =
            22 + picture.at(static_cast<float>(std::clamp(column, 0.0, board.width * 1.0)),
                            static_cast<float>(std::clamp(row, 0.0, board.height * 1.0)), opening) /
                     255 * 206;
        for (int c = 0; c < 3; ++c) {
          sum[static_cast<std::size_t>(c)] +=
              covered ? printed * light : static_cast<float>(pixel[c]);
        }
      }
      for (int c = 0; c < 3; ++c)
        pixel[c] = cv::saturate_cast<std::uint8_t>(sum[static_cast<std::size_t>(c)] / kSamples);
    }
  }
}

}  // namespace swarmsmith::film
