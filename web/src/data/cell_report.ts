// SPDX-License-Identifier: Apache-2.0
// The data block of a page about a cell in motion, written by src/asterism/report/cell_report.cpp.
// Lengths mm, angles deg, times s; quaternions w x y z. "By frame" is in the order of time_s.
import type { Volume } from './layout';
import type { MotionRow, Rig, SummaryRow, Target, Vec3 } from './parts';

export interface CellBody {
  name: string;
  targets: Target[];
  pose: MotionRow[];            // tracker_from_body, by frame
  /// By target: left and right, a character a frame. '.' seen; B behind the camera, V outside the volume, O too
  /// oblique, I outside the image, S too small, C too close to another; a … y hidden by solids[0 … 24], z by a later one.
  sight: [string, string][];
}

export interface CellSolid {
  name: string;
  role: 'workpiece' | 'fixture' | 'obstacle';
  carrier: number;              // a place in bodies; −1 = stands in the tracker's frame
  vertices: string;             // base64 of little-endian float32 x y z, in the carrier's frame
  triangles: string;            // base64 of little-endian uint32, three a triangle
  error_mm: (number | null)[];  // by vertex: worst predicted error over the motion; empty = no map
}

export interface CellAxes { name: string; carrier: number; pose: MotionRow }  // carrier_from_frame

export interface CellPoint {
  name: string;
  position_mm: Vec3;                  // in the verified body's frame
  predicted_mm: (number | null)[];    // √tr Σ, by frame; null: not determined
  covariance_mm2: (number[] | null)[];  // xx xy xz yy yz zz along the tracker's axes, by frame
  measured_mm: (number | null)[];     // simulated, tracked, compared with the truth; null: no pose; empty: not done
  without_mm: (number | null)[];      // the platform's own read-out here; empty: not known here
}

export interface CellHeat {
  title: string; x_label: string; y_label: string; value_label: string;
  x: number[]; y: number[];
  value: (number | null)[][];         // [y][x]
}

export interface CellTable {
  id: string; title: string; note: string;
  columns: string[];
  rows: (string | number | null)[][];
  verdicts: SummaryRow['verdict'][];  // one a row, or none
}

export interface CellChart {
  id: string; title: string; note: string;
  x_label: string; y_label: string;
  log_x: boolean; log_y: boolean;
  curves: { name: string; x: number[]; y: (number | null)[]; low: (number | null)[]; high: (number | null)[]; dashed: boolean }[];
  limits: { name: string; value: number }[];
}

export interface CellReport {
  schema: 'asterism-cell-report/1';
  title: string;
  subtitle: string;
  summary: SummaryRow[];
  remarks: string[];
  rig: Rig;
  volume: Volume | null;
  time_s: number[];
  bodies: CellBody[];
  solids: CellSolid[];
  axes: CellAxes[];
  body: number;                 // whose pose is verified: a place in bodies
  visible: number[];            // by frame: its targets that both cameras see
  coverage: number[];           // by frame; empty = none
  points: CellPoint[];
  predicted_rotation_deg: (number | null)[];
  measured_rotation_deg: (number | null)[];
  status: string;               // a letter a frame (status.ts); empty = not tracked
  without_mm: (number | null)[];  // the platform's own read-out at the centroid of the targets; empty = none
  without_deg: (number | null)[];
  tolerance_mm: number;
  nominal_mm: number;
  heats: CellHeat[];
  tables: CellTable[];
  charts: CellChart[];
  options: unknown;
}
