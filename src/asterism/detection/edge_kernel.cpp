// SPDX-License-Identifier: Apache-2.0
#include "asterism/detection/edge_kernel.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

#include "asterism/detection/lanes.hpp"

namespace asterism {
namespace {

using Lanes = FloatLanes;
using Ints = IntLanes;

ASTERISM_INLINE Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

/// 1/√x to float's precision: a start from the exponent and three Newton steps.
ASTERISM_INLINE Lanes inverse_root(Lanes x) {
  Lanes y = reinterpret_cast<Lanes>(0x5f375a86 - (reinterpret_cast<Ints>(x) >> 1));
  const Lanes half = 0.5F * x;
  y = y * (1.5F - half * y * y);
  y = y * (1.5F - half * y * y);
  return y * (1.5F - half * y * y);
}

/// exp(x) for −80 ≤ x ≤ 0, to 2e-7 relative.
ASTERISM_INLINE Lanes exponential(Lanes x) {
  const Lanes scaled = x * 1.44269504F;
  const Ints whole = __builtin_convertvector(scaled - 0.5F, Ints);
  const Lanes rest = (scaled - __builtin_convertvector(whole, Lanes)) * 0.693147181F;
  Lanes sum = 1.0F / 720 * rest + 1.0F / 120;
  sum = sum * rest + 1.0F / 24;
  sum = sum * rest + 1.0F / 6;
  sum = sum * rest + 0.5F;
  sum = sum * rest + 1.0F;
  sum = sum * rest + 1.0F;
  return sum * reinterpret_cast<Lanes>((whole + 127) << 23);
}

struct Normal {
  Lanes tail, density;  // Φ(−t), φ(t)
};

/// Abramowitz and Stegun 7.1.26: |error| < 1.5e-7.
ASTERISM_INLINE Normal normal(Lanes t) {
  const Ints sign = reinterpret_cast<Ints>(t) & static_cast<int>(0x80000000);
  Lanes size = reinterpret_cast<Lanes>(reinterpret_cast<Ints>(t) ^ sign);
  size = size < 12.0F ? size : Lanes{} + 12.0F;
  const Lanes bell = exponential(-0.5F * size * size);
  const Lanes k = 1.0F / (1.0F + 0.3275911F * 0.707106781F * size);
  Lanes sum = 1.061405429F * k - 1.453152027F;
  sum = sum * k + 1.421413741F;
  sum = sum * k - 0.284496736F;
  sum = sum * k + 0.254829592F;
  const Lanes tail = 0.5F * sum * k * bell;
  return {sign == 0 ? tail : 1.0F - tail, 0.398942280F * bell};
}

struct Constants {
  float x, y, m11, m12, m22, q11, q12, q22, root_determinant, determinant, blur, inverse_blur;

  explicit Constants(const EdgeModel& model)
      : x(static_cast<float>(model.x)),
        y(static_cast<float>(model.y)),
        m11(static_cast<float>(model.m11)),
        m12(static_cast<float>(model.m12)),
        m22(static_cast<float>(model.m22)),
        q11(m11 * m11 + m12 * m12),
        q12(m12 * (m11 + m22)),
        q22(m12 * m12 + m22 * m22),
        root_determinant(m11 * m22 - m12 * m12),
        determinant(root_determinant * root_determinant),
        blur(static_cast<float>(model.blur)),
        inverse_blur(1.0F / blur) {}
};

/// Where eight pixels lie in respect of the ellipse.
struct Place {
  Lanes dx, dy;
  Lanes mx, my;          // M (p − c)
  Lanes qx, qy;          // M² (p − c)
  Lanes inverse_radius;  // 1/f, f = |M (p − c)|
  Lanes inverse_slope;   // 1/|M² (p − c)|
  Lanes distance, curvature;
};

ASTERISM_INLINE Place place(const Constants& c, Lanes dx, Lanes dy) {
  Place p;
  p.dx = dx;
  p.dy = dy;
  p.mx = c.m11 * dx + c.m12 * dy;
  p.my = c.m12 * dx + c.m22 * dy;
  p.qx = c.q11 * dx + c.q12 * dy;
  p.qy = c.q12 * dx + c.q22 * dy;
  // The small numbers keep the centre pixel finite.
  const Lanes square = p.mx * p.mx + p.my * p.my + 1e-8F;
  p.inverse_radius = inverse_root(square);
  p.inverse_slope = inverse_root(p.qx * p.qx + p.qy * p.qy + 1e-8F * c.root_determinant);
  const Lanes radius = square * p.inverse_radius;
  p.distance = (square - radius) * p.inverse_slope;
  const Lanes per_slope = radius * p.inverse_slope;
  p.curvature = c.determinant * per_slope * per_slope * per_slope;
  return p;
}

constexpr Lanes kCount = {0, 1, 2, 3, 4, 5, 6, 7};

ASTERISM_INLINE float sum_of(Lanes v) {
  return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
}

/// Derivatives, weights and residuals of eight pixels.
template <int kN>
struct Rows {
  Lanes j[kN];
  Lanes weight, residual;
};
constexpr int kChunk = 32;

/// The sums that grow from pixel to pixel.
template <int kN>
struct Totals {
  Lanes matrix[NormalSums<kN>::kUpper] = {};
  Lanes right[kN] = {};
  Lanes chi_square = {}, count = {};
};

/// Adds a chunk to one row of the matrix, whose sums stay in registers meanwhile.
template <int kN, int kRow>
ASTERISM_INLINE void add_row(const Rows<kN>* rows, int count, Totals<kN>& totals) {
  constexpr int kFirst = kRow * kN - kRow * (kRow - 1) / 2;
  Lanes sums[kN - kRow + 1];
#pragma GCC unroll 12
  for (int b = 0; b < kN - kRow; ++b) sums[b] = totals.matrix[kFirst + b];
  sums[kN - kRow] = totals.right[kRow];
  for (int i = 0; i < count; ++i) {
    const Lanes weighted = rows[i].weight * rows[i].j[kRow];
#pragma GCC unroll 12
    for (int b = 0; b < kN - kRow; ++b) sums[b] += weighted * rows[i].j[kRow + b];
    sums[kN - kRow] += weighted * rows[i].residual;
  }
#pragma GCC unroll 12
  for (int b = 0; b < kN - kRow; ++b) totals.matrix[kFirst + b] = sums[b];
  totals.right[kRow] = sums[kN - kRow];
}

template <int kN, int... kRow>
ASTERISM_INLINE void add_chunk(const Rows<kN>* rows, int count, Totals<kN>& totals,
                               std::integer_sequence<int, kRow...>) {
  (add_row<kN, kRow>(rows, count, totals), ...);
}

/// Whether no pixel of the eight is near enough to the edge to feel it move.
ASTERISM_INLINE bool all_far(Lanes t) {
  const WordLanes far = reinterpret_cast<WordLanes>(t * t > 20.0F);
  return (far[0] & far[1] & far[2] & far[3]) == ~std::uint64_t{0};
}

/// The share of the disc in a pixel, and how it falls with t, for a profile that is not quite Gaussian.
struct Step {
  Lanes share, fall;
  Lanes diagonal;      // 4c²s² of the edge's normal
  Lanes third, fifth;  // φ He₃, φ He₅
};

struct ProfileConstants {
  float fourth, fourth_diagonal, sixth, sixth_diagonal;

  explicit ProfileConstants(const EdgeProfile& p)
      : fourth(static_cast<float>(p.fourth)),
        fourth_diagonal(static_cast<float>(p.fourth_diagonal)),
        sixth(static_cast<float>(p.sixth)),
        sixth_diagonal(static_cast<float>(p.sixth_diagonal)) {}
};

template <bool kGaussian>
ASTERISM_INLINE Step step_at(const Place& p, const ProfileConstants& profile, Lanes t) {
  const Normal n = normal(t);
  if constexpr (kGaussian) {
    const Lanes none = {};
    return {n.tail, n.density, none, none, none};
  }
  const Lanes t2 = t * t;
  const Lanes cs = p.qx * p.qy * p.inverse_slope * p.inverse_slope;
  Step s;
  s.diagonal = 4.0F * cs * cs;
  s.third = n.density * t * (t2 - 3.0F);
  s.fifth = n.density * t * (t2 * (t2 - 10.0F) + 15.0F);
  const Lanes a = profile.fourth + profile.fourth_diagonal * s.diagonal;
  const Lanes b = profile.sixth + profile.sixth_diagonal * s.diagonal;
  s.share = n.tail + a * s.third + b * s.fifth;
  s.fall =
      n.density * (1.0F + a * (t2 * (t2 - 6.0F) + 3.0F) + b * (t2 * (t2 * (t2 - 15.0F) + 45.0F) - 15.0F));
  return s;
}

template <int kN, bool kGaussian>
ASTERISM_INLINE void accumulate(const Patch& patch, const EdgeModel& model, const EdgeProfile& edge_profile,
                                const EdgeNoise& noise, NormalSums<kN>& result) {
  // Places of amplitude and background in the upper triangle.
  constexpr int kAa = 5 * kN - 10, kAb = kAa + 1, kBb = kAa + kN - 5;
  const Constants c(model);
  const ProfileConstants profile(edge_profile);
  const auto background = static_cast<float>(model.background);
  const auto amplitude = static_cast<float>(model.amplitude);
  const auto v0 = static_cast<float>(noise.outside), v1 = static_cast<float>(noise.linear);
  Totals<kN> totals;
  Rows<kN> rows[kChunk];
  int filled = 0;
  for (int row = 0; row < patch.rows; ++row) {
    const Lanes dy = Lanes{} + (static_cast<float>(row) - c.y);
    const auto [begin, end] = patch.spans[static_cast<std::size_t>(row)];
    for (int column = begin; column < end; column += 8) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(row) * patch.stride + column;
      const Place p = place(c, kCount + (static_cast<float>(column) - c.x), dy);
      const Lanes t = p.distance * c.inverse_blur + 0.5F * c.blur * p.curvature;
      const Lanes usable = load(patch.usable.data() + at);
      const Lanes over = load(patch.grey.data() + at) - background;
      totals.count += usable;
      if (all_far(t)) {
        const Lanes share = t < 0.0F ? Lanes{} + 1.0F : Lanes{};
        const Lanes weight = usable / (v0 + share * v1);
        const Lanes residual = over - amplitude * share;
        const Lanes weighted = weight * share;
        totals.matrix[kAa] += weighted;
        totals.matrix[kAb] += weighted;
        totals.matrix[kBb] += weight;
        totals.right[5] += weighted * residual;
        totals.right[6] += weight * residual;
        totals.chi_square += weight * residual * residual;
        continue;
      }
      const Step s = step_at<kGaussian>(p, profile, t);
      Rows<kN>& r = rows[filled];
      r.residual = over - amplitude * s.share;
      const Lanes bounded = s.share < 0.0F ? Lanes{} : (s.share > 1.0F ? Lanes{} + 1.0F : s.share);
      r.weight = usable / (v0 + bounded * v1);
      // How the grey level changes as the edge moves outwards, per px.
      const Lanes steep = amplitude * s.fall * c.inverse_blur;
      const Lanes along = steep * p.inverse_slope;
      const Lanes by_shape = -along * p.inverse_radius;
      r.j[0] = along * p.qx;
      r.j[1] = along * p.qy;
      r.j[2] = by_shape * p.mx * p.dx;
      r.j[3] = by_shape * (p.mx * p.dy + p.my * p.dx);
      r.j[4] = by_shape * p.my * p.dy;
      r.j[5] = s.share;
      r.j[6] = Lanes{} + 1.0F;
      r.j[7] = steep * (p.distance * c.inverse_blur - 0.5F * c.blur * p.curvature);
      if constexpr (kN > EdgeModel::kParameters) {
        r.j[8] = amplitude * s.third;
        r.j[9] = r.j[8] * s.diagonal;
        r.j[10] = amplitude * s.fifth;
        r.j[11] = r.j[10] * s.diagonal;
      }
      totals.chi_square += r.weight * r.residual * r.residual;
      if (++filled == kChunk) {
        add_chunk(rows, filled, totals, std::make_integer_sequence<int, kN>());
        filled = 0;
      }
    }
  }
  add_chunk(rows, filled, totals, std::make_integer_sequence<int, kN>());
  for (int k = 0; k < NormalSums<kN>::kUpper; ++k) {
    result.matrix[static_cast<std::size_t>(k)] = sum_of(totals.matrix[k]);
  }
  for (int a = 0; a < kN; ++a) result.right[static_cast<std::size_t>(a)] = sum_of(totals.right[a]);
  result.chi_square = sum_of(totals.chi_square);
  result.usable = sum_of(totals.count);
}

ASTERISM_CLONES void accumulate_gaussian(const Patch& patch, const EdgeModel& model, const EdgeNoise& noise,
                                         NormalSums<8>& result) {
  accumulate<8, true>(patch, model, {}, noise, result);
}

ASTERISM_CLONES void accumulate_8(const Patch& patch, const EdgeModel& model, const EdgeProfile& profile,
                                  const EdgeNoise& noise, NormalSums<8>& result) {
  accumulate<8, false>(patch, model, profile, noise, result);
}

ASTERISM_CLONES void accumulate_12(const Patch& patch, const EdgeModel& model, const EdgeProfile& profile,
                                   const EdgeNoise& noise, NormalSums<12>& result) {
  accumulate<12, false>(patch, model, profile, noise, result);
}

ASTERISM_CLONES void all_distances(const Patch& patch, const EdgeModel& model, float* distance) {
  const Constants c(model);
  for (int row = 0; row < patch.rows; ++row) {
    const Lanes dy = Lanes{} + (static_cast<float>(row) - c.y);
    const auto [begin, end] = patch.spans[static_cast<std::size_t>(row)];
    for (int column = begin; column < end; column += 8) {
      const Place p = place(c, kCount + (static_cast<float>(column) - c.x), dy);
      std::memcpy(distance + static_cast<std::ptrdiff_t>(row) * patch.stride + column, &p.distance,
                  sizeof p.distance);
    }
  }
}

}  // namespace

NormalEquations normal_equations(const Patch& patch, const EdgeModel& model, const EdgeProfile& profile,
                                 const EdgeNoise& noise) {
  NormalEquations result;
  if (profile == EdgeProfile{}) {
    accumulate_gaussian(patch, model, noise, result);
  } else {
    accumulate_8(patch, model, profile, noise, result);
  }
  return result;
}

ProfileEquations profile_equations(const Patch& patch, const EdgeModel& model, const EdgeProfile& profile,
                                   const EdgeNoise& noise) {
  ProfileEquations result;
  accumulate_12(patch, model, profile, noise, result);
  return result;
}

std::vector<float> distances(const Patch& patch, const EdgeModel& model) {
  std::vector<float> result(patch.grey.size());
  all_distances(patch, model, result.data());
  return result;
}

}  // namespace asterism
