#include <algorithm>
#include <array>

#include "analysis/drawing/svg.h"

namespace swarmsmith {
namespace {

/// Advance widths of DejaVu Sans 2.37, the widest of the figures' fonts, in thousandths of its
/// size, from the blank to the tilde (table `hmtx` of DejaVuSans.ttf).
constexpr std::array<int, 95> kWidths = {
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
    575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
    611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};
/// The width of an ellipsis, used for all other characters, too.
constexpr int kWidest = 1000;
constexpr std::string_view kEllipsis = "\u2026";

bool begins_character(char letter) {
  return (static_cast<unsigned char>(letter) & 0xc0U) != 0x80U;
}

}  // namespace

std::size_t characters_in(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, begins_character));
}

double text_width(std::string_view text, double size) {
  int sum = 0;
  for (const char letter : text) {
    const bool is_plain = letter >= ' ' && letter <= '~';
    if (is_plain) sum += kWidths[static_cast<std::size_t>(letter - ' ')];
    if (!is_plain && begins_character(letter)) sum += kWidest;
  }
  return size * sum / 1000;
}

std::string fitted_text(std::string_view text, double size, double width) {
  if (text_width(text, size) <= width) return std::string(text);
  while (!text.empty() && text_width(text, size) + text_width(kEllipsis, size) > width) {
    // Removes all bytes of the last character.
    while (text.size() > 1 && !begins_character(text.back()))
      text.remove_suffix(1);
    text.remove_suffix(1);
  }
  return std::string(text).append(kEllipsis);
}

}  // namespace swarmsmith
