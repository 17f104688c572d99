// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "asterism/camera/image.hpp"
#include "asterism/detection/detect.hpp"
#include "asterism/detection/threshold_map.hpp"

namespace asterism {

/// What may be a disc: an ellipse good to some tenths of a pixel, from moments at half its height.
struct Candidate {
  Ellipse ellipse;
  double contrast = 0;      // grey levels between just inside and just outside of the outline
  double edge_support = 0;  // share of the outline where the level falls by a good part of that
};

struct FoundCandidates {
  std::vector<Candidate> candidates;
  double step = 1;       // the smallest grey step in use
  double brightest = 0;  // grey level, of all that stands out
};

/// Looks for discs with the threshold map, then inside each component at levels between background and peak:
/// so two discs joined by their blur, a disc on a bright plate, a disc beside a lamp are found as well.
template <class Grey>
[[nodiscard]] FoundCandidates find_candidates(const Raster<Grey>& image, Tone<Grey> tone,
                                              const DetectionOptions& options);

}  // namespace asterism
