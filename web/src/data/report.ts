// SPDX-License-Identifier: Apache-2.0
// The data block of report.html, written by src/asterism/report/tracking_report.cpp.
// Lengths mm, times s, pixels px; quaternions w x y z; frames named as in the C++ code.

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

/// A motion's seven; then xx xy xz yy yz zz of the named point's covariance (mm²) and of the rotation's
/// (rad²), both along the tracker's axes.
export type PoseRow = number[];

export interface Target {
  id: string;
  position_mm: Vec3;  // in the body's frame
  normal?: Vec3;
  diameter_mm?: number;
}

/// How one target was seen: in `seen` a character a frame (0 hidden, 1 left, 2 right, 3 both), and
/// measured less computed image position (px) by camera.
export interface Sightings {
  seen: string;
  left_px: ([number, number] | null)[];
  right_px: ([number, number] | null)[];
}

export interface BodyTrack {
  name: string;
  targets: Target[];
  point: { name: string; position_mm: Vec3 };  // where accuracy is told
  status: string;                              // a letter a frame: see status.ts
  measured: (PoseRow | null)[];                // tracker_from_body, by each frame alone
  filtered_status?: string;
  filtered?: (PoseRow | null)[];
  targets_used: number[];
  rms_px: (number | null)[];
  sightings: Sightings[];                      // in the order of targets
  truth?: (MotionRow | null)[];
}

export interface TrackingReport {
  schema: 'asterism-tracking-report/1';
  title: string;
  subtitle: string;
  summary: SummaryRow[];
  remarks: string[];
  rig: { left: Lens; right: Lens; right_from_left: MotionRow };
  frames: { frame: number[]; time_s: number[]; centres_left: number[]; centres_right: number[] };
  bodies: BodyTrack[];
  options: unknown;
}

/// The data block's text as a report; says what is wrong when it is none.
export function parseReport(text: string): TrackingReport {
  const data: unknown = JSON.parse(text);
  if (data === null || typeof data !== 'object') throw new Error('this page holds no data: asterism writes them into it');
  const schema = (data as { schema?: unknown }).schema;
  if (schema !== 'asterism-tracking-report/1') throw new Error(`this page cannot show data of the form "${String(schema)}"`);
  return data as TrackingReport;
}
