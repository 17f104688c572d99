// SPDX-License-Identifier: Apache-2.0
/// Viridis at nine even steps: rises evenly in lightness, also for the colour-blind and in grey print.
export const kRampStops = ['#440154', '#472d7b', '#3b528b', '#2c728e', '#21918c', '#28ae80', '#5ec962', '#addc30', '#fde725'];

function channel(colour: string, k: number): number {
  return parseInt(colour.slice(1 + 2 * k, 3 + 2 * k), 16);
}

/// A colour for a part of the way from 0 to 1.
export function ramp(part: number): string {
  const at = Math.min(1, Math.max(0, part)) * (kRampStops.length - 1);
  const low = Math.min(kRampStops.length - 2, Math.floor(at));
  const mixed = [0, 1, 2].map((k) => Math.round(channel(kRampStops[low], k) + (at - low) * (channel(kRampStops[low + 1], k) - channel(kRampStops[low], k))));
  return `#${mixed.map((v) => v.toString(16).padStart(2, '0')).join('')}`;
}

export function rampAsCss(): string {
  return `linear-gradient(to right, ${kRampStops.join(', ')})`;
}
