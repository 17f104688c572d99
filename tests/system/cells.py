#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cells as a user writes them: what is refused, in which words, and what is kept. cells.py PROGRAM"""
import json
import os
import sys
import unittest

from program import ProgramTest

CELL = """
[tracker]
range_mm = 2000
[platform]
[workpiece]
mesh = "part.off"
unit = "mm"
[[body]]
name = "platform"
motion = {kind = "sweep", pose = {seen_at_mm = [0, 0, 0], range_mm = 2000, elevation_deg = 60}, roll = {amplitude_deg = 15, frequency_hz = 0.5}}
target = [
  {id = "A", position_mm = [300, 0, 0], normal = [0, 0, 1], diameter_mm = 12},
  {id = "B", position_mm = [-250, 150, 20], normal = [0, 0, 1], diameter_mm = 12},
  {id = "C", position_mm = [-200, -220, 0], normal = [0, 0, 1], diameter_mm = 12},
  {id = "D", position_mm = [40, 280, 50], normal = [0, 0, 1], diameter_mm = 12}]
[timing]
frames = 3
"""
CORNERS = [(0, 0, 0), (100, 0, 0), (0, 100, 0), (0, 0, 100)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def off(corners=CORNERS, faces=FACES, scale=1.0):
    lines = [f"OFF {len(corners)} {len(faces)} 0"]
    lines += [" ".join(str(scale * x) for x in corner) for corner in corners]
    lines += ["3 " + " ".join(str(i) for i in face) for face in faces]
    return "\n".join(lines) + "\n"


def grid(side):
    """A wavy sheet of 2·side² triangles, 400 mm wide."""
    step = 400 / side
    corners = [(step * i - 200, step * j - 200, (i * j) % 7) for j in range(side + 1) for i in range(side + 1)]
    faces = []
    for j in range(side):
        for i in range(side):
            a = j * (side + 1) + i
            faces += [(a, a + 1, a + side + 2), (a, a + side + 2, a + side + 1)]
    return off(corners, faces)


class Cells(ProgramTest):
    def cell(self, mesh, *changes):
        text = CELL
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.at / "part.off").write_text(mesh)
        (self.at / "cell.toml").write_text(text)
        return self.at / "cell.toml"

    def simulate(self, cell, out="out", **options):
        return self.run_program("simulate", cell, "--out", self.at / out, "--level", "centres", "--progress", "none", **options)

    def not_simulated(self, message, mesh, *changes):
        self.refused(message, "simulate", self.cell(mesh, *changes), "--out", self.at / "out")

    def test_schema_is_json_and_knows_every_table(self):
        schema = json.loads(self.run_program("schema").stdout)
        self.assertEqual(schema["$schema"], "https://json-schema.org/draft/2020-12/schema")
        for table in ("tracker", "platform", "workpiece", "fixture", "scanner", "noise", "fault", "lamp", "verify", "layout"):
            self.assertIn(table, schema["properties"])

    def test_parts_that_cannot_be_are_refused_in_words(self):
        self.not_simulated('part.off: is 0.1 mm long in mm; metres would make it 100 mm: say unit = "m"', off(scale=1e-3))
        self.not_simulated("is 100 m long in m; millimetres would make it 100 mm", off(), ('"mm"', '"m"'))
        self.not_simulated("the mesh is inside out: its triangles face inwards; say flip = true", off(faces=[f[::-1] for f in FACES]))
        self.not_simulated("part.off: holds no triangles", off(faces=[]))
        self.not_simulated("part.off:3: a coordinate is `nan`; it must be finite", off([CORNERS[0], (float("nan"), 0, 0), *CORNERS[2:]]))
        self.not_simulated("part.off:9: a face has corner 4, counted from 0; the file has 4 vertices", off(faces=FACES[:3] + [(1, 2, 4)]))
        self.not_simulated("target `A` of body `platform` is inside it, 10.0 mm deep", off(), ("[300, 0, 0]", "[10, 20, 30]"))

    def test_odd_surfaces_are_taken_with_a_warning(self):
        done = self.simulate(self.cell(off(faces=FACES[:3])))
        self.assertIn("warning: `workpiece`: the surface is open, edges of one triangle alone: 3", done.stderr)
        fin = off(CORNERS + [(-50, -50, 50)], FACES + [(0, 3, 4)])
        self.assertIn("the surface is not manifold, edges of more than two triangles: 1", self.simulate(self.cell(fin)).stderr)
        self.assertNotIn("warning", self.simulate(self.cell(off())).stderr)

    def test_a_platform_stays_within_its_stroke(self):
        self.not_simulated("body `platform`: goes beyond the platform's stroke: roll 16.00° at 0.50 s; ±15° is allowed", off(),
                           ("amplitude_deg = 15", "amplitude_deg = 16"))
        self.not_simulated("body `platform`: is faster than the platform: roll at 471.2°/s", off(), ("frequency_hz = 0.5", "frequency_hz = 5"))

    def test_a_million_triangles_are_fine(self):
        self.simulate(self.cell(grid(708)))

    def test_meshes_are_sought_in_the_data_path(self):
        cell = self.cell(off())
        (self.at / "meshes").mkdir()
        (self.at / "part.off").rename(self.at / "meshes/part.off")
        self.refused("cell.toml:6: mesh `part.off` is not there; it is sought beside the cell and in ASTERISM_DATA_PATH", "simulate", cell,
                     "--out", self.at / "out")
        self.simulate(cell, env={**os.environ, "ASTERISM_DATA_PATH": f"/nowhere:{self.at / 'meshes'}"})

    def test_a_recording_keeps_its_cell_with_the_part(self):
        self.simulate(self.cell(off()))
        self.simulate(self.at / "out/cell.toml", "again")
        first, again = ((self.at / folder / "cell.workpiece.ply").read_bytes() for folder in ("out", "again"))
        self.assertEqual(first, again)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
