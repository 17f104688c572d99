// SPDX-License-Identifier: Apache-2.0
// The data block of report.html, written by src/asterism/report/tracking_report.cpp.
// Lengths mm, times s, pixels px; quaternions w x y z; frames named as in the C++ code.
import type { MotionRow, Rig, SummaryRow, Target, Vec3 } from './parts';

/// A motion's seven; then xx xy xz yy yz zz of the named point's covariance (mm²) and of the rotation's
/// (rad²), both along the tracker's axes.
export type PoseRow = number[];

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
  rig: Rig;
  frames: { frame: number[]; time_s: number[]; centres_left: number[]; centres_right: number[] };
  bodies: BodyTrack[];
  options: unknown;
}
