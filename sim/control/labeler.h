#pragma once

#include <span>

#include "sim/control/reference_model.h"

namespace swarmsmith {

/// The colour labeler (thesis 3.2), a node between colour sensor and control software. Robots see
/// the same floor darker or lighter, so the nearest label replaces the reading.
///
/// label = argmin_i d_i (eq. 3.1), d_i = (R - R_i)^2 + (G - G_i)^2 + (B - B_i)^2 (eq. 3.2) over the
/// channels' values 0..255; in a tie the first label wins. Without labels the reading is unchanged.
Rgb nearest_label(Rgb reading, std::span<const Rgb> labels);

}  // namespace swarmsmith
