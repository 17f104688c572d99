#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""From a plan of views to one cloud and to the plan of what it lacks, as a user goes. scans.py PROGRAM"""
import json
import unittest

from program import ProgramTest

# A coarse plan of the built-in cell, its platform at rest: a few views in a second or two.
COARSE = ["--samples", "1500", "--candidates", "300", "--rounds", "0", "--exact-s", "0"]


class Scans(ProgramTest):
    def plan(self, out, *more):
        return json.loads(self.run_program("plan", "engine_casing", "--out", out, "--json", *COARSE, *more).stdout)

    def carry_out(self, plan, out):
        self.run_program("simulate", "engine_casing", "--plan", plan, "--out", out, "--level", "centres", "--view-s", "0.5", "--pace", "10")
        self.run_program("track", out, "--out", out / "track", "--covariance")

    def test_plan_scan_fuse_and_plan_what_is_missing(self):
        first = self.plan(self.at / "plan.json", "--platform-steps", "1")
        self.assertGreaterEqual(first["views"], first["bound"])
        self.assertLess(first["covered_mm2"], first["coverable_mm2"] + 1)
        self.carry_out(self.at / "plan.json", self.at / "scan")
        fused = json.loads(self.run_program("fuse", self.at / "scan", "--out", self.at / "cloud.ply", "--voxel-mm", "2", "--json").stdout)
        self.assertEqual(fused["frame"], "workpiece")
        self.assertEqual(len(fused["scans"]), first["views"])
        self.assertFalse([scan["scan"] for scan in fused["scans"] if scan.get("registration", {}).get("disagrees")])
        # What the plan covers is what the cloud measures, but for the rims of each view.
        planned = first["covered_mm2"] / first["surface_mm2"]
        self.assertAlmostEqual(fused["completeness"]["share"], planned, delta=0.03)
        # Some twenty scans share the systematic error of one drawn scanner: the ratio scatters by a quarter.
        ratio = fused["deviation"]["rms_mm"] / fused["deviation"]["predicted_rms_mm"]
        self.assertLess(ratio, 1.35)
        self.assertGreater(ratio, 0.65)

        rest = self.plan(self.at / "rescan.json", "--platform-steps", "3", "--complete", self.at / "cloud.ply")
        self.assertGreater(rest["platform_poses"], 1)
        self.assertAlmostEqual(rest["covered_before_mm2"] / rest["surface_mm2"], fused["completeness"]["share"], delta=0.03)
        self.assertGreater(rest["covered_mm2"], 1.5 * first["covered_mm2"])

    def test_scans_without_a_pose_in_time_are_said(self):
        self.plan(self.at / "plan.json", "--platform-steps", "1")
        scan = self.at / "scan"
        self.carry_out(self.at / "plan.json", scan)
        poses = (scan / "track" / "poses.csv").read_text().splitlines()
        (scan / "track" / "poses.csv").write_text("\n".join(poses[: len(poses) // 2]) + "\n")
        (scan / "track" / "poses.json").unlink()
        result = self.run_program("fuse", scan, "--out", self.at / "cloud.ply", "--json")
        fused = json.loads(result.stdout)
        self.assertGreater(fused["left_out"]["outside_run"], 1000)
        self.assertIn("have no pose at their time", result.stderr)


if __name__ == "__main__":
    unittest.main()
