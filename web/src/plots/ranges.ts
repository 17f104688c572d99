// SPDX-License-Identifier: Apache-2.0
/// The range of a plot's values with a little room; from zero where the quantity is a size.
export function rangeOf(low: number | null, high: number | null, fromZero: boolean): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  const bottom = fromZero ? Math.min(0, low) : low;
  const room = (high - bottom || Math.abs(high) || 1) * 0.08;
  return [fromZero && bottom === 0 ? 0 : bottom - room, high + room];
}
