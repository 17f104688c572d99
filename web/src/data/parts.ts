// SPDX-License-Identifier: Apache-2.0
// What the data blocks of all reports share. Lengths mm, pixels px; quaternions w x y z.

export type Vec3 = [number, number, number];

export interface SummaryRow {
  label: string;
  value: string;
  unit: string;
  note: string;
  verdict: 'plain' | 'good' | 'attention' | 'bad';
}

export interface Lens {
  fx: number; fy: number; skew: number; cx: number; cy: number;  // px
  distortion: number[];                                          // OpenCV's order
  width_px: number; height_px: number;
}

/// x y z (mm), w x y z.
export type MotionRow = [number, number, number, number, number, number, number];

export interface Rig {
  left: Lens;
  right: Lens;
  right_from_left: MotionRow;
}

export interface Target {
  id: string;
  position_mm: Vec3;  // in the body's frame
  normal?: Vec3;
  diameter_mm?: number;
}
