#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Scores and searches layouts as a user does: files, messages, and the same front however it was run. layouts.py PROGRAM"""
import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from program import PROGRAM, ProgramTest

CELL = (Path(__file__).resolve().parents[2] / "examples/cells/engine_casing.toml").read_text()
MPIRUN = shutil.which("mpirun")
AS_ROOT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


class Layouts(ProgramTest):
    def cell(self, *changes):
        """The example, looked at in fewer poses so that a search is quick."""
        text = CELL.replace("poses = 200", "poses = 25")
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.at / "cell.toml").write_text(text)
        return self.at / "cell.toml"

    def optimize(self, out, *words, status=0, **options):
        self.run_program("layout", "optimize", self.at / "cell.toml", "--out", self.at / out, "--population", 40, "--progress", "none",
                         *words, status=status, **options)
        return self.summary(out)

    def summary(self, out):
        return json.loads((self.at / out / "summary.json").read_text())

    # What a user sees

    def test_its_commands_show_examples_and_wrong_words_the_nearest(self):
        for command in ("evaluate", "optimize", "suggest"):
            self.assertIn(f"Example:\n  asterism layout {command}", self.run_program("layout", command, "--help").stdout)
        self.refused("layout: `optimise` is no command; did you mean `optimize`?", "layout", "optimise")
        self.refused("layout: a command is needed, one of: evaluate, optimize, suggest", "layout")
        self.refused("layout optimize: `--populaton` is no option of it; did you mean `--population`?", "layout", "optimize", "a", "--out",
                     "b", "--populaton", 3)

    def test_evaluate_says_what_a_layout_breaks_and_where_it_is_weak(self):
        cell = self.cell(("losses = 1", "losses = 2"))
        done = self.run_program("layout", "evaluate", cell, "--published", "--json", "--out", self.at / "out")
        present, *published = json.loads(done.stdout)["layouts"]
        self.assertFalse(present["feasible"])
        self.assertRegex(present["breaks"][0], r"visible is \d, at least 6 asked: \d missing")
        self.assertEqual(len(published), 8)
        # Table 9's S1 can be taken for itself half a turn round.
        self.assertAlmostEqual(next(one for one in published if one["name"].endswith("9 S1"))["quantities"]["identifiability"], 0.271, delta=2e-3)
        page = (self.at / "out/report.html").read_text()
        self.assertIn('"asterism-layout-report/1"', page)
        self.assertIn("fit as", page)
        text = self.run_program("layout", "evaluate", cell).stdout
        self.assertIn("✗ visible is", text)

    def test_optimize_writes_whole_files_that_the_other_commands_take(self):
        cell = self.cell()
        done = self.run_program("layout", "optimize", cell, "--out", self.at / "out", "--generations", 15, "--population", 40, "--json",
                                "--progress", "plain")
        summary = json.loads(done.stdout)
        self.assertEqual(summary, self.summary("out"))
        self.assertIn("hypervolume", done.stderr)
        self.assertFalse(list((self.at / "out").rglob("*.partial")))
        rows = list(csv.DictReader((self.at / "out/front.csv").read_text().splitlines()))
        self.assertEqual(len(rows), summary["front_told"])
        self.assertEqual([row["layout"] for row in rows if row["knee"] == "true"], [f"{summary['knee']:02}"])
        self.assertEqual(len(list((self.at / "out/layouts").iterdir())), len(rows))
        bodies = [self.at / "out/layouts" / row["layout"] / "bodies.toml" for row in rows[:3]]
        scored = json.loads(self.run_program("layout", "evaluate", cell, "--json", "--bodies", *bodies).stdout)["layouts"][1:]
        for row, layout in zip(rows, scored):
            self.assertTrue(layout["feasible"], layout["breaks"])
            self.assertEqual(layout["name"], row["layout"])
            self.assertAlmostEqual(layout["quantities"]["worst-error-1-lost"], float(row["worst_error_1_lost_mm"]), delta=1e-6)

    def test_a_shorter_front_takes_the_place_of_a_longer_one(self):
        self.cell()
        first = self.optimize("out", "--generations", 10)
        second = self.optimize("out", "--generations", 10, "--most-designs", 2)
        self.assertEqual((first["front_checksum"], second["front_told"]), (second["front_checksum"], 2))
        self.assertEqual(sorted(path.name for path in (self.at / "out/layouts").iterdir()), ["01", "02"])

    def test_the_papers_objectives_are_warned_about(self):
        self.cell()
        done = self.run_program("layout", "optimize", self.at / "cell.toml", "--out", self.at / "out", "--objectives", "targets,mean-spacing",
                                "--generations", 3, "--population", 20, "--progress", "none")
        self.assertIn("do not conflict", done.stderr)
        self.assertIn("do not conflict", (self.at / "out/report.html").read_text())

    # The same bits

    def test_any_number_of_threads_gives_the_same_front(self):
        self.cell()
        marks = {self.optimize(f"out{threads}", "--generations", 12, "--threads", threads)["front_checksum"] for threads in (1, 2, 4)}
        self.assertEqual(len(marks), 1)

    @unittest.skipUnless(MPIRUN, "no mpirun here")
    def test_any_number_of_processes_gives_the_same_front(self):
        self.cell()
        for extra in ((), ("--islands", 3, "--migration-interval", 4)):
            alone = self.optimize("alone", "--generations", 12, *extra)["front_checksum"]
            for ranks in (1, 2, 4):
                together = self.optimize(f"ranks{ranks}", "--generations", 12, *extra, before=(MPIRUN, "--oversubscribe", "-np", str(ranks)), env=AS_ROOT)
                self.assertEqual(together["front_checksum"], alone, f"{ranks} processes {extra}")

    @unittest.skipUnless(MPIRUN, "no mpirun here")
    def test_wrong_input_ends_all_processes_with_one_message(self):
        done = subprocess.run([MPIRUN, "--oversubscribe", "-np", "2", PROGRAM, "layout", "optimize", self.at / "none.toml", "--out", self.at],
                              capture_output=True, text=True, timeout=60, env=AS_ROOT)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("none.toml"), 1)

    def begun(self, out, generations):
        """A search under way that has written a checkpoint."""
        words = [PROGRAM, "layout", "optimize", self.at / "cell.toml", "--out", self.at / out, "--population", 40, "--generations", generations,
                 "--checkpoint-seconds", 0, "--progress", "none"]
        running = subprocess.Popen([str(word) for word in words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and not (self.at / out / "checkpoint").exists():
            time.sleep(0.005)
        return running

    def test_a_killed_search_resumes_to_the_same_front(self):
        self.cell()
        whole = self.optimize("whole", "--generations", 60)
        running = self.begun("killed", 60)
        running.kill()
        running.communicate()
        self.assertEqual(running.returncode, -signal.SIGKILL)
        self.assertFalse((self.at / "killed/summary.json").exists())
        resumed = self.optimize("killed", "--generations", 60, "--resume")
        self.assertEqual(resumed["front_checksum"], whole["front_checksum"])
        self.assertEqual(resumed["evaluations"], whole["evaluations"])
        more = self.optimize("killed", "--generations", 70, "--resume")
        self.assertEqual(more["generations"], 70)

    def test_ctrl_c_ends_after_the_generation_with_whole_files(self):
        self.cell()
        running = self.begun("out", 100000)
        running.send_signal(signal.SIGINT)
        _, error = running.communicate(timeout=60)
        self.assertEqual(running.returncode, 130, error)
        self.assertIn("--resume goes on", error)
        summary = self.summary("out")
        self.assertEqual(summary["ended"], "stopped")
        self.assertFalse(list((self.at / "out").rglob("*.partial")))
        again = self.optimize("out", "--generations", summary["generations"] + 5, "--resume")
        self.assertEqual(again["generations"], summary["generations"] + 5)

    # What to change next

    def suggest(self, *words, status=0):
        return json.loads(self.run_program("layout", "suggest", *words, "--json", "--places", 150, "--progress", "none", status=status).stdout)

    def test_suggest_says_what_to_change_and_writes_it(self):
        cell = self.cell()
        found = self.suggest(cell, "--out", self.at / "next")
        self.assertEqual(found, json.loads((self.at / "next/suggestion.json").read_text()))
        self.assertIn(found["best"]["kind"], ("move", "add"))
        self.assertIn(found["best"]["target"], found["verdict"])
        self.assertTrue(any("visible" in limit for limit in found["limits"]), found["limits"])
        scored = json.loads(self.run_program("layout", "evaluate", cell, "--json", "--bodies", self.at / "next/bodies.toml").stdout)["layouts"]
        self.assertGreaterEqual(scored[1]["quantities"]["visible"], scored[0]["quantities"]["visible"])
        self.assertIn("platform top", self.run_program("layout", "suggest", cell, "--places", 150).stdout)

    def test_suggest_names_a_target_that_was_knocked_in_a_recording(self):
        fault = '[[fault]]\nkind = "knocked"\nbody = "platform"\ntarget = "P2"\ntime_s = 1.0\nshift_mm = [0.8, -0.5, 0.0]\n\n[layout]  # where'
        cell = self.cell(("[layout]  # where", fault))
        self.run_program("simulate", cell, "--out", self.at / "recording", "--level", "centres", "--sigma-px", 0.05, "--progress", "none")
        found = self.suggest(self.at / "recording", "--out", self.at / "next")
        (named,) = [target for target in found["targets"] if target["observed"]["displaced"]]
        self.assertEqual(named["id"], "P2")
        for measured, true in zip(named["observed"]["displaced"]["mm"], (0.8, -0.5, 0.0)):
            self.assertAlmostEqual(measured, true, delta=0.15)
        self.assertAlmostEqual(named["observed"]["displaced"]["since_s"], 1.0, delta=0.3)
        self.assertEqual(found["relearn"][0]["target"], "P2")

    def test_suggest_without_a_cell_judges_what_is_there(self):
        self.run_program("simulate", self.cell(), "--out", self.at / "recording", "--level", "centres", "--sigma-px", 0.05, "--progress", "none")
        (self.at / "recording/cell.toml").unlink()
        self.refused("name one with --body: platform, scanner", "layout", "suggest", self.at / "recording", "--progress", "none")
        done = self.run_program("layout", "suggest", self.at / "recording", "--body", "platform", "--json", "--progress", "none",
                                status=None)
        self.assertIn("without a cell nothing is known of where targets may stand", done.stderr)
        self.assertEqual(json.loads(done.stdout)["move"], [])

    def test_suggest_refuses_wrong_words(self):
        cell = self.cell()
        self.refused("`swap` is none of move, add, remove", "layout", "suggest", cell, "--kinds", "swap")
        self.refused("is no recording's folder but a cell itself", "layout", "suggest", cell, "--cell", cell)
        self.refused("the cell's layout task is of `platform`", "layout", "suggest", cell, "--body", "scanner")
        done = self.refused("No single change mends what is broken", "layout", "suggest", cell, "--kinds", "remove", status=3)
        self.assertIn("remove", done.stdout)

    # Wrong input

    def refused_search(self, part, *words, status=2):
        return self.refused(part, "layout", "optimize", self.at / "cell.toml", "--out", self.at / "out", "--generations", 3, "--population", 20,
                            "--progress", "none", "--json", *words, status=status)

    def test_unknown_names_tell_the_nearest(self):
        self.cell()
        self.refused_search("did you mean `worst-error`?", "--objectives", "targets,worst-eror")
        self.refused_search("did you mean `thickness`?", "--constraints", "thicknes >= 3")
        self.refused("cell.toml:", "layout", "evaluate", self.cell(("fewest = 4", "fewset = 4")))

    def test_a_cell_without_a_layout_task(self):
        cell = self.at / "cell.toml"
        cell.write_text(CELL[:CELL.index("[layout]")])
        self.refused("[layout]", "layout", "evaluate", cell)
        self.refused_search("layout")

    def test_an_infeasible_problem_names_the_constraint_and_by_how_much(self):
        self.cell()
        done = self.run_program("layout", "optimize", self.at / "cell.toml", "--out", self.at / "out", "--generations", 3, "--population", 20,
                                "--progress", "none", "--constraints", "worst-error-1-lost <= 0.0001", status=3)
        last = done.stderr.strip().splitlines()[-1]
        self.assertRegex(last, r"worst-error-1-lost.* by (about )?0\.\d+")
        self.assertIn("closest to feasible", done.stdout)
        self.assertTrue((self.at / "out/report.html").exists())

    def test_a_surface_too_small_for_the_targets(self):
        self.cell(("spacing_mm = 100", "spacing_mm = 680"))
        self.refused_search("spacing")

    def test_targets_that_no_camera_can_see(self):
        self.cell(("tilt_deg = 20", "tilt_deg = 20"), ("elevation_deg = 60", "elevation_deg = -60"))
        done = self.refused_search("s")
        self.assertIn("seen", done.stderr)

    def test_checkpoints_of_other_problems_or_cut_short(self):
        self.cell()
        self.refused_search("checkpoint", "--resume")
        self.optimize("out", "--generations", 3)
        before = (self.at / "out/checkpoint").read_bytes()
        self.refused("checkpoint", "layout", "optimize", self.at / "cell.toml", "--out", self.at / "out", "--population", 40, "--resume",
                     "--objectives", "targets,worst-error", "--progress", "none")
        self.refused("checkpoint", "layout", "optimize", self.at / "cell.toml", "--out", self.at / "out", "--population", 40, "--resume",
                     "--seed", 2, "--progress", "none")
        self.assertEqual((self.at / "out/checkpoint").read_bytes(), before)
        (self.at / "out/checkpoint").write_bytes(before[: len(before) // 2])
        self.refused("checkpoint", "layout", "optimize", self.at / "cell.toml", "--out", self.at / "out", "--population", 40, "--resume",
                     "--progress", "none")
        self.assertEqual(len((self.at / "out/checkpoint").read_bytes()), len(before) // 2)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
