#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the built program as a user does: exit statuses, messages, and files that are whole. run.py PROGRAM"""
import json
import random
import signal
import subprocess
import sys
import time
import unittest

from program import PROGRAM, ProgramTest

RIG = """%YAML:1.0
---
image_width: 640
image_height: 480
K1: !!opencv-matrix {rows: 3, cols: 3, dt: d, data: [ 800., 0., 320., 0., 800., 240., 0., 0., 1. ]}
K2: !!opencv-matrix {rows: 3, cols: 3, dt: d, data: [ 800., 0., 320., 0., 800., 240., 0., 0., 1. ]}
R: !!opencv-matrix {rows: 3, cols: 3, dt: d, data: [ 1., 0., 0., 0., 1., 0., 0., 0., 1. ]}
T: !!opencv-matrix {rows: 3, cols: 1, dt: d, data: [ -400., 0., 0. ]}
"""
TARGETS = [(0, 0, 0), (220, 0, 20), (0, 300, -40), (260, 270, 60), (90, 120, 110)]


def bodies(places=TARGETS, ids=None):
    text = '[[body]]\nname = "part"\n'
    for i, place in enumerate(places):
        name = ids[i] if ids else f"P{i}"
        text += f'[[body.target]]\nid = "{name}"\nposition_mm = [{place[0]}, {place[1]}, {place[2]}]\n'
    return text


def images_of(place):
    """Left and right pixel of a point of the body, which stands at (-100, -100, 2000) unturned."""
    x, y, z = place[0] - 100, place[1] - 100, place[2] + 2000
    return (320 + 800 * x / z, 240 + 800 * y / z), (320 + 800 * (x - 400) / z, 240 + 800 * y / z)


random.seed(1)
GROUND = bytes(max(0, round(random.gauss(20, 1.5))) for _ in range(640 * 480))  # dark, with a sensor's noise


def disc_image(centres, radius=6.0):
    """A PGM of bright discs with soft edges on a dark ground."""
    pixels = bytearray(GROUND)
    for cx, cy in centres:
        for y in range(max(0, int(cy - 9)), min(480, int(cy + 10))):
            for x in range(max(0, int(cx - 9)), min(640, int(cx + 10))):
                edge = radius - ((x - cx) ** 2 + (y - cy) ** 2) ** 0.5
                pixels[640 * y + x] += int(180 * min(1, max(0, edge + 0.5)))
    return b"P5\n640 480\n255\n" + bytes(pixels)


class System(ProgramTest):
    def recording(self, frames=4, images=True):
        (self.at / "rig.yaml").write_text(RIG)
        (self.at / "bodies.toml").write_text(bodies())
        rows = ["frame,time_s,left,right"]
        seen = [images_of(place) for place in TARGETS]
        for frame in range(frames):
            names = [f"{side}/{frame}.pgm" for side in ("left", "right")] if images else ["", ""]
            rows.append(f"{frame},{0.1 * frame:.1f},{names[0]},{names[1]}")
            for side, name in enumerate(names if images else []):
                (self.at / name).parent.mkdir(exist_ok=True)
                (self.at / name).write_bytes(disc_image([views[side] for views in seen]))
        (self.at / "frames.csv").write_text("\n".join(rows) + "\n")
        if not images:
            rows = ["frame,camera,centre,x_px,y_px,sigma_x_px,sigma_y_px"]
            for frame in range(frames):
                for side, camera in enumerate(("left", "right")):
                    rows += [f"{frame},{camera},{i},{views[side][0]:.6f},{views[side][1]:.6f},0.02,0.02"
                             for i, views in enumerate(seen)]
            (self.at / "centres.csv").write_text("\n".join(rows) + "\n")
        return self.at

    def summary(self, out="out"):
        return json.loads((self.at / out / "summary.json").read_text())

    # Usage

    def test_help_of_every_command_shows_an_example(self):
        listed = self.run_program("--help").stdout.split("Subcommands:")[1]
        commands = [line.split()[0] for line in listed.splitlines() if line.startswith("  ") and line[2] != " "]
        self.assertIn("track", commands)
        for command in commands:
            text = self.run_program(command, "--help").stdout
            self.assertIn("Example:\n  asterism " + command, text, command)

    def test_wrong_words_name_the_nearest(self):
        self.refused("`trak` is no command; did you mean `track`?", "trak")
        self.refused("`--polarty` is no option of it; did you mean `--polarity`?", "detect", "a.png", "--polarty", "dark")
        self.refused("--out is required", "detect", "a.png")
        self.refused("a command is needed")
        self.refused("`polarity` is `grey`; it must be one of: bright, dark", "detect", "a.png", "--out", self.at / "c.csv",
                     "--polarity", "grey")

    def test_options_file_tells_line_and_nearest_key(self):
        config = self.at / "o.toml"
        config.write_text("\nmin_diametre_px = 3\n")
        self.refused("o.toml:2: `min_diametre_px` is no key of the options; did you mean `min_diameter_px`?", "detect", "a.png",
                     "--out", self.at / "c.csv", "--config", config)

    # The measuring chain

    def test_track_measures_the_pose_and_stores_its_options(self):
        self.recording()
        config = self.at / "o.toml"
        config.write_text("[detection]\nmin_diameter_px = 4.5\nmax_diameter_px = 90\n")
        done = self.run_program("track", self.at, "--out", self.at / "out", "--json", "--covariance", "--tum", "--config", config,
                                "--min-diameter-px", "5")
        self.assertEqual(json.loads(done.stdout), self.summary())
        summary = self.summary()
        self.assertEqual(summary["bodies"][0]["status"]["OK"], 4)
        self.assertEqual(summary["options"]["detection"]["min_diameter_px"], 5)
        self.assertEqual(summary["options"]["detection"]["max_diameter_px"], 90)
        row = (self.at / "out/poses.csv").read_text().splitlines()[1].split(",")
        for value, wanted in zip(row[4:7], (-100, -100, 2000)):
            self.assertAlmostEqual(float(value), wanted, delta=0.3)
        for name in ("centres.csv", "points.csv", "poses_filtered.csv", "poses_smoothed.csv", "poses.json", "part.tum"):
            self.assertTrue((self.at / "out" / name).read_text(), name)
        self.assertFalse(list((self.at / "out").glob("*.partial")))

    def test_track_carries_a_platform_through_darkness_by_its_read_out(self):
        self.run_program("simulate", "engine_casing", "--level", "centres", "--out", self.at / "run")
        table = self.at / "run/centres.csv"
        rows = table.read_text().splitlines()
        table.write_text("\n".join(row for row in rows if not 50 <= int(row.split(",")[0].replace("frame", "0")) < 60) + "\n")
        done = self.run_program("track", self.at / "run", "--out", self.at / "out", "--read-out", self.at / "run/read_out.csv",
                                "--read-out-body", "platform", "--json")
        told = json.loads(done.stdout)["fusion"]
        self.assertEqual(told, json.loads((self.at / "out/fusion.json").read_text()))
        self.assertLess(abs(told["latency_s"]), 5 * told["latency_sigma_s"])
        self.assertLess(told["latency_sigma_s"], 1e-3)
        self.assertGreaterEqual(told["status"]["PREDICTED"], 10)
        errors = {}
        for name in ("poses_fused", "poses_filtered"):
            done = self.run_program("evaluate", self.at / f"out/{name}.csv", "--truth", self.at / "run/truth_poses.csv",
                                    "--body", "platform", "--at", "0,500,600", "--json")
            errors[name] = json.loads(done.stdout)["bodies"][0]["translation_mm"]["max"]
        self.assertLess(errors["poses_fused"], 4)  # the read-out's own noise there, and how fast a body may turn
        self.assertGreater(errors["poses_filtered"], 10 * errors["poses_fused"])
        self.refused("`platfrom` is no body of the recording; did you mean `platform`?", "track", self.at / "run", "--out", self.at / "out",
                     "--read-out", self.at / "run/read_out.csv", "--read-out-body", "platfrom")

    def test_steps_one_by_one_give_what_track_gives(self):
        self.recording(2)
        images = sorted(self.at.glob("*/*.pgm"))
        self.run_program("detect", *images, "--out", self.at / "c.csv")
        self.run_program("triangulate", "--rig", self.at / "rig.yaml", "--left", self.at / "c.csv", "--right", self.at / "c.csv",
                         "--out", self.at / "p.csv")
        self.run_program("identify", "--bodies", self.at / "bodies.toml", "--points", self.at / "p.csv", "--out", self.at / "l.csv")
        labels = [line.split(",") for line in (self.at / "l.csv").read_text().splitlines()[1:]]
        named = [label for label in labels if label[2]]
        self.assertEqual(sorted(label[3] for label in named), sorted(["P0", "P1", "P2", "P3", "P4"] * 2))
        self.assertTrue(all(label[4] == "OK" for label in named))

    def test_evaluate_finds_nothing_wrong_with_the_truth(self):
        self.recording(images=False)
        self.run_program("track", self.at, "--out", self.at / "out", "--covariance")
        done = self.run_program("evaluate", self.at / "out/poses.csv", "--truth", self.at / "out/poses.csv", "--at", "0,0,100",
                                "--covariance", self.at / "out/poses.json", "--json")
        body = json.loads(done.stdout)["bodies"][0]
        self.assertEqual((body["found"], body["wrong"], body["translation_mm"]["max"]), (4, [], 0))
        self.assertTrue(body["nees"]["correlations_known"])
        other = self.at / "other.csv"
        other.write_text("frame,body,x_mm,y_mm,z_mm,qw,qx,qy,qz\n9,part,0,0,0,1,0,0,0\n")
        self.refused("no frame of", "evaluate", self.at / "out/poses.csv", "--truth", other, status=3)

    def test_reproduce_gives_each_number_of_the_paper_a_verdict(self):
        told = json.loads(self.run_program("reproduce", "--out", self.at / "paper", "--json").stdout)
        ledger = (self.at / "paper/ledger.csv").read_text().splitlines()
        self.assertEqual(ledger[0], "id,where,quantity,published,computed,definition,verdict,reason")
        self.assertEqual(len(ledger) - 1, told["rows"])
        self.assertEqual(sum(told["verdicts"].values()), told["rows"])
        self.assertIn("<svg", (self.at / "paper/reproduction.html").read_text())
        text = self.run_program("reproduce", "--out", self.at / "one", "--only", "T10", "T2.3.s").stdout
        self.assertIn("16 quantities of the paper", text)

    def test_reproduce_refuses_what_it_cannot_do(self):
        self.refused("--out is required", "reproduce")
        self.refused("`T10.S1.f9` is no row, table or figure of the paper; did you mean `T10.S1.f1`?",
                     "reproduce", "--out", self.at / "paper", "--only", "T10.S1.f9")
        self.assertFalse((self.at / "paper").exists())
        (self.at / "file").write_text("")
        self.refused("file", "reproduce", "--out", self.at / "file")

    def test_any_number_of_threads_gives_the_same_bits(self):
        self.recording()
        for threads in (1, 2):
            self.run_program("track", self.at, "--out", self.at / str(threads), "--threads", threads)
        for name in ("centres.csv", "points.csv", "poses.csv", "poses_filtered.csv", "poses_smoothed.csv"):
            self.assertEqual((self.at / "1" / name).read_bytes(), (self.at / "2" / name).read_bytes(), name)

    # Wrong input

    def test_a_cut_off_image_costs_its_frame_and_no_other(self):
        self.recording()
        image = self.at / "left/2.pgm"
        image.write_bytes(image.read_bytes()[:100000])
        done = self.run_program("track", self.at, "--out", self.at / "out")
        self.assertIn("left/2.pgm: the image is cut off", done.stderr)
        summary = self.summary()
        self.assertEqual(summary["bodies"][0]["status"]["OK"], 3)
        self.assertEqual(summary["bodies"][0]["status"]["LOST"], 1)
        self.assertEqual(summary["unreadable_images"][0]["frame"], 2)
        self.refused("2.pgm: the image is cut off", "detect", *sorted((self.at / "left").iterdir()), "--out", self.at / "c.csv")
        self.assertEqual(len((self.at / "c.csv").read_text().splitlines()), 1 + 3 * len(TARGETS))

    def test_images_of_another_size_than_the_rigs(self):
        self.recording()
        for image in (self.at / "left").iterdir():
            image.write_bytes(b"P5\n2 2\n255\n0000")
        self.refused("is 2 × 2 px but the rig was calibrated at 640 × 480", "track", self.at, "--out", self.at / "out")

    def test_black_white_and_crowded_frames_are_lost_not_fatal(self):
        self.recording(3)
        crowd = [(8 + 6 * i, 8 + 6 * j) for i in range(104) for j in range(77)]
        dots = bytearray([20]) * (640 * 480)
        for x, y in crowd:
            for dy in range(3):
                for dx in range(3):
                    dots[640 * (y + dy) + x + dx] = 220
        for frame, grey in enumerate((bytes([0]) * (640 * 480), bytes([255]) * (640 * 480), bytes(dots))):
            for side in ("left", "right"):
                (self.at / side / f"{frame}.pgm").write_bytes(b"P5\n640 480\n255\n" + grey)
        self.refused("no body got a pose in any frame", "track", self.at, "--out", self.at / "out", status=3)
        self.assertEqual(self.summary()["bodies"][0]["status"]["OK"], 0)

    def test_absent_images_and_time_that_goes_back_name_their_line(self):
        self.recording()
        (self.at / "right/1.pgm").unlink()
        self.refused("frames.csv:3: column `right`: the image", "track", self.at, "--out", self.at / "out")
        (self.at / "frames.csv").write_text("frame,time_s,left,right\n0,1.0,left/0.pgm,\n1,0.5,left/1.pgm,\n")
        self.refused("frames.csv:3: column `time_s`: time must go on", "track", self.at, "--out", self.at / "out")

    def test_rigs_that_cannot_be(self):
        self.recording(images=False)
        for old, new, part in (("800.", ".Nan", "`K1` holds a value that is not a finite number"),
                               ("800.", "0.", "`K1` must be"), ("-400.", "0.", "the baseline"),
                               ("image_width", "image_widht", "did you mean `image_width`?")):
            (self.at / "rig.yaml").write_text(RIG.replace(old, new, 1))
            done = self.refused("rig.yaml", "track", self.at, "--out", self.at / "out")
            self.assertIn(part, done.stderr)

    def test_bodies_that_cannot_be_tracked(self):
        self.recording(images=False)
        for text, part in ((bodies(ids=["P0", "P1", "P1", "P3", "P4"]), "target id `P1` is given twice"),
                           (bodies([(0, 0, 0), (100, 0, 0), (250, 0, 0), (600, 0, 0)]), "its targets lie on one line"),
                           (bodies(TARGETS[:2]), "has 2 targets; a pose needs three or more"),
                           (bodies() + "colour = 3\n", "bodies.toml:18: `colour` is no key of a target")):
            (self.at / "bodies.toml").write_text(text)
            self.refused(part, "track", self.at, "--out", self.at / "out")

    def test_missing_files_are_named(self):
        self.refused("is no folder", "track", self.at / "none", "--out", self.at / "out")
        self.refused("no images here", "detect", self.at / "none.png", "--out", self.at / "c.csv")
        self.recording(images=False)
        (self.at / "rig.yaml").unlink()
        self.refused("has no rig.yaml; name one with --rig", "track", self.at, "--out", self.at / "out")

    # What happens while writing

    def test_a_full_disk_keeps_what_was_measured(self):
        self.recording(400, images=False)
        limited = f"ulimit -f 64; trap '' XFSZ; exec {PROGRAM} track {self.at} --out {self.at}/out --progress none"
        done = subprocess.run(["bash", "-c", limited], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("cannot be written", done.stderr)
        kept = (self.at / "out/poses.csv.partial").read_text()
        self.assertTrue(kept.endswith("\n"))
        self.assertGreater(kept.count(",OK,"), 50)
        self.refused("/dev/full: cannot be written: No space left on device", "detect", self.image(), "--out", "/dev/full")

    def image(self):
        file = self.at / "one.pgm"
        file.write_bytes(disc_image([(100, 100)]))
        return file

    def test_ctrl_c_leaves_whole_files(self):
        self.recording(20000, images=False)
        running = subprocess.Popen([PROGRAM, "track", self.at, "--out", self.at / "out", "--progress", "none"],
                                   stderr=subprocess.PIPE, text=True)
        partial = self.at / "out/poses.csv.partial"
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and not (partial.exists() and partial.stat().st_size > 0):
            time.sleep(0.01)
        running.send_signal(signal.SIGINT)
        _, error = running.communicate(timeout=60)
        self.assertEqual(running.returncode, 130, error)
        self.assertFalse((self.at / "out/poses.csv").exists())
        self.assertTrue(partial.read_text().endswith("\n"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
