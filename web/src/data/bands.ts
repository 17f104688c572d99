// SPDX-License-Identifier: Apache-2.0
import type { Covariance } from './pose';

/// 95 % of a normal variable lie within this many standard deviations.
export const kNormal95 = 1.959964;

/// 95 % of a three-dimensional normal variable lie inside the ellipsoid this many sigmas in size: √7.8147.
export const kEllipsoid95 = 2.795483;

/// The length which |e| stays below with probability 95 % for e ~ N(0, C): |e|² = Σ λᵢ χ²₁ is given the mean,
/// variance and skewness of a shifted χ² (Pearson; Imhof 1961, eq. 4.2). The traces of C, C², C³ suffice, no
/// eigenvalues. Within 1 % of the exact value.
export function lengthBound95(c: Covariance): number {
  const [xx, xy, xz, yy, yz, zz] = c;
  // Squares first, scaled by the trace so that small covariances lose nothing.
  const first = xx + yy + zz;
  if (!(first > 0)) return 0;
  const m = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map((row) => row.map((value) => value / first));
  let second = 0;
  let third = 0;
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) {
      const square = m[i][0] * m[0][j] + m[i][1] * m[1][j] + m[i][2] * m[2][j];
      second += m[i][j] * m[j][i];
      third += square * m[j][i];
    }
  }
  const degrees = second ** 3 / third ** 2;
  const quantile = (chiSquare95(degrees) - degrees) * Math.sqrt(second / degrees) + 1;
  return Math.sqrt(first * Math.max(0, quantile));
}

/// 95 % quantiles of χ² with 1, 1.5, 2, 2.5 and 3 degrees of freedom.
const kQuantiles = [3.841459, 4.980195, 5.991465, 6.928076, 7.814728];

/// 95 % quantile of χ² with 1 to 3 degrees of freedom, by Lagrange's polynomial through exact values.
export function chiSquare95(degrees: number): number {
  const at = 2 * (Math.min(3, Math.max(1, degrees)) - 1);
  return kQuantiles.reduce((sum, value, i) => {
    const weight = kQuantiles.reduce((product, _, k) => (k === i ? product : (product * (at - k)) / (i - k)), 1);
    return sum + value * weight;
  }, 0);
}
