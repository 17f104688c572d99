// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { chiSquare95, lengthBound95 } from './bands';
import { apply, cholesky, inverse, motionOf, type Covariance } from './pose';
import { conjugate, product, rotate, rotationVector, type Quaternion } from './quaternion';
import { quantile, rms } from './statistics';

const quarterAboutZ: Quaternion = [Math.SQRT1_2, 0, 0, Math.SQRT1_2];

/// Reproducible normal numbers (mulberry32 and Box–Muller).
function normals(seed: number): () => number {
  let state = seed;
  const uniform = () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  return () => Math.sqrt(-2 * Math.log(1 - uniform())) * Math.cos(2 * Math.PI * uniform());
}

describe('quaternions', () => {
  it('turn x to y by a quarter about z', () => {
    const [x, y, z] = rotate(quarterAboutZ, [1, 0, 0]);
    expect(x).toBeCloseTo(0, 12);
    expect(y).toBeCloseTo(1, 12);
    expect(z).toBeCloseTo(0, 12);
  });
  it('combine like the rotations they stand for', () => {
    const a: Quaternion = [0.5, 0.5, -0.5, 0.5];
    const both = rotate(product(a, quarterAboutZ), [1, 2, 3]);
    const oneByOne = rotate(a, rotate(quarterAboutZ, [1, 2, 3]));
    both.forEach((value, k) => expect(value).toBeCloseTo(oneByOne[k], 12));
  });
  it('give the rotation vector, whatever the sign of the quaternion', () => {
    for (const sign of [1, -1]) {
      const q = quarterAboutZ.map((value) => sign * value) as Quaternion;
      expect(rotationVector(q)[2]).toBeCloseTo(Math.PI / 2, 12);
    }
  });
  it('keep tiny angles', () => {
    expect(rotationVector([1, 1e-13, 0, 0])[0]).toBeCloseTo(2e-13, 20);
    expect(rotationVector(product(quarterAboutZ, conjugate(quarterAboutZ)))).toEqual([0, 0, 0]);
  });
});

describe('motions', () => {
  it('undo themselves', () => {
    const motion = motionOf([1, 2, 3, 0.5, 0.5, -0.5, 0.5]);
    apply(inverse(motion), apply(motion, [7, -8, 9])).forEach((value, k) => expect(value).toBeCloseTo([7, -8, 9][k], 12));
  });
});

describe('cholesky', () => {
  it('gives back the covariance', () => {
    const c: Covariance = [4, 1.2, -0.6, 2, 0.3, 1.5];
    const [a, b, d, e, f, g] = cholesky(c);
    [a * a, a * b, a * e, b * b + d * d, b * e + d * f, e * e + f * f + g * g].forEach((value, k) => expect(value).toBeCloseTo(c[k], 12));
  });
  it('bears a covariance without extent along an axis', () => {
    expect(cholesky([0, 0, 0, 4, 0, 1])).toEqual([0, 0, 2, 0, 0, 1]);
  });
});

describe('lengthBound95', () => {
  it('is the exact quantile for equal axes: √7.8147 σ', () => {
    expect(lengthBound95([4e-6, 0, 0, 4e-6, 0, 4e-6]) / 2e-3).toBeCloseTo(2.795483, 4);
  });
  it('is the normal one for a single axis', () => {
    expect(lengthBound95([0, 0, 0, 0, 0, 9]) / 3).toBeCloseTo(1.959964, 4);
  });
  it('holds 95 % of drawn errors for a long and tilted ellipsoid', () => {
    const c: Covariance = [1, 0.4, 1.5, 0.7, 0.9, 9];
    const [a, b, d, e, f, g] = cholesky(c);
    const bound = lengthBound95(c);
    const normal = normals(3);
    let inside = 0;
    const draws = 40_000;
    for (let i = 0; i < draws; ++i) {
      const [u, v, w] = [normal(), normal(), normal()];
      if (Math.hypot(a * u, b * u + d * v, e * u + f * v + g * w) <= bound) ++inside;
    }
    // Three sigmas of 40,000 draws are 0.33 %, the approximation's own error about as much.
    expect(Math.abs(inside / draws - 0.95)).toBeLessThan(0.007);
  });
  it('is nothing for a covariance of nothing', () => expect(lengthBound95([0, 0, 0, 0, 0, 0])).toBe(0));
});

describe('statistics', () => {
  it('know the χ² table', () => {
    expect(chiSquare95(3)).toBeCloseTo(7.814728, 6);
    expect(chiSquare95(1.25)).toBeCloseTo(4.432, 2);
  });
  it('take quantiles between the ordered values', () => {
    expect(quantile([4, 1, 3, 2], 0.5)).toBe(2.5);
    expect(quantile([5], 0.95)).toBe(5);
    expect(quantile([], 0.5)).toBeNull();
  });
  it('have no RMS of nothing', () => {
    expect(rms([])).toBeNull();
    expect(rms([3, 4, -5])).toBeCloseTo(Math.sqrt(50 / 3), 12);
  });
});
