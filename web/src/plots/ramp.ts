// SPDX-License-Identifier: Apache-2.0
/// Viridis at nine even steps: rises evenly in lightness, also for the colour-blind and in grey print.
const kStops = ['#440154', '#472d7b', '#3b528b', '#2c728e', '#21918c', '#28ae80', '#5ec962', '#addc30', '#fde725'];

function channel(colour: string, k: number): number {
  return parseInt(colour.slice(1 + 2 * k, 3 + 2 * k), 16);
}

/// A colour for a part of the way from 0 to 1.
export function ramp(part: number): string {
  const at = Math.min(1, Math.max(0, part)) * (kStops.length - 1);
  const low = Math.min(kStops.length - 2, Math.floor(at));
  const mixed = [0, 1, 2].map((k) => Math.round(channel(kStops[low], k) + (at - low) * (channel(kStops[low + 1], k) - channel(kStops[low], k))));
  return `#${mixed.map((v) => v.toString(16).padStart(2, '0')).join('')}`;
}

export function rampAsCss(): string {
  return `linear-gradient(to right, ${kStops.join(', ')})`;
}
