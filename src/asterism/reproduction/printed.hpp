// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>

#include "asterism/geometry/types.hpp"

// The paper's tables as they are printed (Machines 2025, 13, 592). Numbers that are compared stand as text,
// for their last digit says how far they were rounded. Tables 1 and 9 are in cell/paper_layouts.hpp.

namespace asterism::printed {

struct Frame {  // Table 2
  std::string max_radius_mm, symmetry_mm;
};
inline const std::array<Frame, 3> kTable2 = {
    {{"311.67", "29.213"}, {"343.19", "20.395"}, {"313.73", "40.679"}}};

/// Table 9 prints this for the second target of S4.
inline const Vec3 kTable9S4P2{-220, -220, 590};

struct Crowding {  // Table 10
  std::string f1_mm, coverage_mm, distance;
};
inline const std::array<Crowding, 5> kTable10 = {{{"661.46", "2663.13", "Inf"},
                                                  {"778.8", "4780.50", "1.786"},
                                                  {"850.57", "5736.66", "0.734"},
                                                  {"768.4", "5736.66", "1.266"},
                                                  {"797.6", "5736.66", "Inf"}}};

struct Survivor {  // Table 11
  std::string f1_mm, f2_mm;
};
inline const std::array<Survivor, 5> kTable11 = {{{"1059.8", "-8049.3"},
                                                  {"660.77", "-2643.9"},
                                                  {"1059.8", "-6521.7"},
                                                  {"118.9", "-4780.5"},
                                                  {"669.23", "-3005.8"}}};

inline const std::array<Vec3, 4> kTable12 = {
    {Vec3(250, 0, 600), Vec3(0, 300, 610), Vec3(-250, 0, 590), Vec3(0, -300, 605)}};

struct PoseErrors {  // Table 13
  std::string mean_rotation_deg, max_rotation_deg, mean_translation_mm, max_translation_mm;
};
inline const std::array<PoseErrors, 3> kTable13 = {{{"0.035", "0.068", "0.099", "0.247"},
                                                    {"0.036", "0.071", "0.102", "0.240"},
                                                    {"0.034", "0.067", "0.095", "0.243"}}};

struct ConfidenceInterval {  // Table 14
  std::string low_mm, high_mm;
};
inline const std::array<ConfidenceInterval, 3> kTable14 = {
    {{"0.1434", "0.1810"}, {"0.1434", "0.1914"}, {"0.1382", "0.1774"}}};

inline constexpr int kRuns = 50;  // of Tables 13 and 14

struct PValue {  // Figure 24
  int a, b;      // schemes, from 0
  std::string p;
};
inline const std::array<PValue, 3> kFigure24 = {{{0, 1, "0.07352"}, {1, 2, "0.05227"}, {0, 2, "0.07335"}}};

/// Table 15: 93 points; Table 16: 72. In the order of print, row by row, mm.
[[nodiscard]] std::span<const Vec3> table15();
[[nodiscard]] std::span<const Vec3> table16();

}  // namespace asterism::printed
