// SPDX-License-Identifier: Apache-2.0
// The data block of a page about plan, scans and cloud, written by src/asterism/report/scan_report.cpp. All in the
// workpiece's frame: lengths mm, angles deg, times s. Packed numbers are base64, lowest byte first.
import type { CellChart, CellSolid, CellTable } from './cell_report';
import type { MotionRow, SummaryRow, Vec3 } from './parts';

export interface Scanner {
  stand_off_mm: number; near_mm: number; far_mm: number;
  field_width_mm: number; field_height_mm: number;  // at the stand-off, along its x and y
  baseline_mm: number;
  max_incidence_deg: number; good_incidence_deg: number;
}

/// Places of the surface that plans and completeness tell about.
export interface SampleList {
  places: string;     // float32 x y z
  normals: string;    // int8 x y z, 127 = 1
  areas_mm2: string;  // float32
}

export interface PlannedView {
  pose: MotionRow;              // workpiece_from_scanner; z looks at the part
  platform: number;             // a place in the plan's poses
  measures: string;             // a bit a sample
  adds_mm2: number;             // area that no view before it measures
  mean_incidence_deg: number;
  beyond_good_incidence: number;  // share
  worst_sigma_mm: number | null;
  scanner_targets: number; platform_targets: number;
  starts_s: number;
}

export interface PlatformPose { yaw_deg: number; pitch_deg: number; roll_deg: number }

export interface ScanPlan {
  samples: number;              // a place in sample_lists; −1 = none
  poses: PlatformPose[];
  views: PlannedView[];         // in the order of the tour
  bound: number; optimal: boolean; greedy_views: number; candidates: number;
  in_words: string;
  surface_mm2: number; reachable_mm2: number; coverable_mm2: number;
  covered_before_mm2: number; covered_mm2: number;
  limits: { limit: string; area_mm2: number }[];
  covered_before: string;       // a bit a sample
  tour_s: number; nearest_neighbour_s: number;
  remarks: string[];
}

/// The points of a cloud that are drawn: whole points, not means.
export interface PackedCloud {
  points: number; drawn: number;  // of how many, how many
  voxel_mm: number;               // one was kept of each such cube; 0 = all are drawn
  low_mm: Vec3; step_mm: number;
  places: string;                 // uint16 x y z, in steps from low_mm
  normals: string;                // int8 x y z; empty = none
  fields: { name: string; whole: boolean; values: string }[];  // whole: uint16, 65535 = none; else half floats, NaN = none
}

export interface Hole { area_mm2: number; centre: Vec3; normal: Vec3; across_mm: number; samples: string }

export interface Completeness {
  samples: number;
  measured: string;             // a bit a sample
  surface_mm2: number; measured_mm2: number;
  holes: Hole[];                // largest first
}

export interface DeviationSummary {
  region: string;
  points: number; beyond: number;
  mean_mm: number | null; rms_mm: number | null; sigma_mm: number | null;
  p05_mm: number | null; median_mm: number | null; p95_mm: number | null; lowest_mm: number | null; highest_mm: number | null;
  in_tolerance: number | null; below: number | null; above: number | null;
  predicted_rms_mm: number | null;  // 0 = not known
}

export interface Deviation {
  whole: DeviationSummary;
  regions: DeviationSummary[];
  bin_mm: number;
  histogram: number[];          // about zero
}

export interface ScanRound {
  name: string;
  plan: ScanPlan | null;
  cloud: PackedCloud | null;
  completeness: Completeness | null;
  deviation: Deviation | null;
}

export interface ScanReport {
  schema: 'asterism-scan-report/1';
  title: string;
  subtitle: string;
  links: { text: string; href: string }[];  // other pages beside this one
  summary: SummaryRow[];
  remarks: string[];
  scanner: Scanner;
  surface: CellSolid | null;
  sample_lists: SampleList[];
  rounds: ScanRound[];
  tolerance_mm: number;         // of the deviation, to either side
  view_s: number;
  turn_s: number;
  tables: CellTable[];
  charts: CellChart[];
  options: unknown;
}
