// SPDX-License-Identifier: Apache-2.0
import { roundStep } from '../data/format';

/// The range of values above zero on a logarithmic axis: to the next of 1, 2, 5 times a power of ten.
export function logRangeOf(low: number, high: number): [number, number] {
  if (!(low > 0) || !(high > low)) return high > 0 ? [high / 10, high * 2] : [0.1, 1];
  const bottom = roundStep(low);
  let top = roundStep(high);
  while (top < high) top *= 1.25;
  return [bottom, top];
}

/// The range of a plot's values with a little room; from zero where the quantity is a size.
export function rangeOf(low: number | null, high: number | null, fromZero: boolean): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  const bottom = fromZero ? Math.min(0, low) : low;
  const room = (high - bottom || Math.abs(high) || 1) * 0.08;
  return [fromZero && bottom === 0 ? 0 : bottom - room, high + room];
}
