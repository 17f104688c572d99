#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Clouds as users have them: compared with a surface, and read by CloudCompare. clouds.py PROGRAM"""
import json
import math
import os
import random
import shutil
import statistics
import struct
import subprocess
import unittest

from program import ProgramTest

CLOUD_COMPARE = shutil.which("CloudCompare") or shutil.which("cloudcompare.CloudCompare")
RADIUS = 50


def ball(rings=60, radius=RADIUS):
    """Vertices and triangles of a ball; within the sphere by 2 R (1 - cos(pi/120)) = 0.034 mm at most."""
    vertices, faces = [], []
    for i in range(rings + 1):
        up = -math.pi / 2 + math.pi * i / rings
        for k in range(2 * rings):
            turn = math.pi * k / rings
            vertices.append((radius * math.cos(up) * math.cos(turn), radius * math.cos(up) * math.sin(turn), radius * math.sin(up)))
    for i in range(rings):
        for k in range(2 * rings):
            a, b = i * 2 * rings + k, i * 2 * rings + (k + 1) % (2 * rings)
            if i > 0:
                faces.append((a, b, b + 2 * rings))
            if i < rings - 1:
                faces.append((a, b + 2 * rings, a + 2 * rings))
    return vertices, faces


def ply_mesh(vertices, faces, flip=False):
    head = f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
    head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    order = (0, 2, 1) if flip else (0, 1, 2)
    rows = ["%.12g %.12g %.12g" % place for place in vertices]
    rows += ["3 %d %d %d" % tuple(face[i] for i in order) for face in faces]
    return head + "\n".join(rows) + "\n"


def ply_cloud(points, normals):
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
    head += "".join(f"property double {axis}\n" for axis in "xyz")
    head += "".join(f"property float n{axis}\n" for axis in "xyz")
    head += "property float scalar_sigma_mm\nend_header\n"
    rows = [struct.pack("<3d4f", *point, *normal, 0.03) for point, normal in zip(points, normals)]
    return head.encode() + b"".join(rows)


def scan(count=20000, off=0.1, sigma=0.03, only=lambda normal: True):
    """Points around the ball, `off` above the sphere, with noise."""
    draw = random.Random(1)
    points, normals = [], []
    while len(points) < count:
        way = [draw.gauss(0, 1) for _ in range(3)]
        length = math.hypot(*way)
        normal = [x / length for x in way]
        if not only(normal):
            continue
        height = RADIUS + off + draw.gauss(0, sigma)
        points.append([height * x for x in normal])
        normals.append(normal)
    return points, normals


class Clouds(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.at / "ball.ply").write_text(ply_mesh(*ball()))

    def cloud(self, *args, scale=1.0, **options):
        points, normals = scan(*args, **options)
        (self.at / "cloud.ply").write_bytes(ply_cloud([[scale * x for x in p] for p in points], normals))
        return self.at / "cloud.ply"

    def compared(self, cloud, *words):
        done = self.run_program("compare", cloud, "--mesh", self.at / "ball.ply", "--json", "--progress", "none", *words)
        return json.loads(done.stdout)

    def test_compare_tells_how_far_off_and_how_much(self):
        result = self.compared(self.cloud(only=lambda normal: normal[2] > 0), "--points", 2)
        deviation, completeness = result["deviation"], result["completeness"]
        self.assertEqual(deviation["points"], 20000)
        # 0.1 mm above the sphere, and the mesh lies up to 0.034 mm within it.
        self.assertGreater(deviation["mean_mm"], 0.1)
        self.assertLess(deviation["mean_mm"], 0.134)
        self.assertAlmostEqual(deviation["predicted_rms_mm"], 0.03, 6)
        # One half, and 5 mm beyond the equator count too: (1 + 4/50) / 2; 20,000 samples.
        self.assertGreater(completeness["share"], 0.5)
        self.assertLess(completeness["share"], 0.56)
        hole = completeness["holes"][0]
        self.assertGreater(hole["area_mm2"], 0.44 * 4 * math.pi * RADIUS**2)
        self.assertLess(hole["normal"][2], -0.99)

    def test_compare_writes_the_cloud_with_its_deviations(self):
        out = self.at / "with.ply"
        self.compared(self.cloud(2000), "--out", out)
        head = out.read_bytes().split(b"end_header\n")[0].decode()
        for name in ("double x", "float nx", "float scalar_sigma_mm", "float scalar_deviation_mm"):
            self.assertIn("property " + name, head)
        again = self.compared(out)
        self.assertEqual(again["deviation"]["points"], 2000)

    def test_compare_says_what_is_wrong(self):
        cloud, mesh = self.cloud(500), self.at / "ball.ply"
        self.refused("one of --cell and --mesh is needed", "compare", cloud)
        self.refused("none.ply", "compare", self.at / "none.ply", "--mesh", mesh)
        (self.at / "flipped.ply").write_text(ply_mesh(*ball(), flip=True))
        self.refused("inside out", "compare", cloud, "--mesh", self.at / "flipped.ply")
        (self.at / "empty.ply").write_bytes(ply_cloud([], []))
        self.refused("empty.ply", "compare", self.at / "empty.ply", "--mesh", mesh)
        self.refused("say --unit m", "compare", self.cloud(500, scale=1e-3), "--mesh", mesh)
        self.assertEqual(self.compared(self.at / "cloud.ply", "--unit", "m")["deviation"]["points"], 500)
        points, normals = scan(500)
        (self.at / "elsewhere.ply").write_bytes(ply_cloud([[p[0] + 900, p[1], p[2]] for p in points], normals))
        self.refused("must stand in one frame", "compare", self.at / "elsewhere.ply", "--mesh", mesh)
        (self.at / "against.ply").write_bytes(ply_cloud(points, [[-x for x in n] for n in normals]))
        self.refused("face against the surface's", "compare", self.at / "against.ply", "--mesh", mesh)
        self.compared(self.at / "against.ply", "--without-normals")

    def test_compare_remarks_that_a_surface_is_open(self):
        vertices, faces = ball()
        (self.at / "open.ply").write_text(ply_mesh(vertices, faces[:-200]))
        done = self.run_program("compare", self.cloud(500), "--mesh", self.at / "open.ply")
        self.assertIn("the surface is open", done.stderr)

    @unittest.skipUnless(CLOUD_COMPARE, "CloudCompare is not installed (Debian: cloudcompare)")
    def test_cloud_compare_reads_our_cloud_and_finds_our_deviations(self):
        out, table = self.at / "with.ply", self.at / "table.asc"
        ours = self.compared(self.cloud(), "--out", out)["deviation"]
        words = [CLOUD_COMPARE, "-SILENT", "-AUTO_SAVE", "OFF", "-C_EXPORT_FMT", "ASC", "-PREC", "9", "-ADD_HEADER", "-SEP", "SPACE"]
        words += ["-O", out, "-O", self.at / "ball.ply", "-C2M_DIST", "-SAVE_CLOUDS", "FILE", table]
        surroundings = dict(os.environ, QT_QPA_PLATFORM="offscreen", HOME=str(self.at), XDG_RUNTIME_DIR=str(self.at))
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=100, env=surroundings)
        self.assertTrue(table.exists(), done.stdout + done.stderr)
        lines = table.read_text().splitlines()
        names = lines[0].lstrip("/").split()
        self.assertEqual(names, ["X", "Y", "Z", "sigma_mm", "deviation_mm", "C2M_signed_distances", "Nx", "Ny", "Nz"])
        rows = [[float(word) for word in line.split()] for line in lines[1:]]
        self.assertEqual(len(rows), 20000)
        theirs = [row[5] for row in rows]
        # Both are exact but for CloudCompare's single precision: 24 bits of 50 mm are 3 nm, and it takes
        # products of such; by a point, and in the mean.
        worst = max(abs(row[4] - row[5]) for row in rows)
        self.assertLess(worst, 2e-4)
        self.assertAlmostEqual(statistics.fmean(theirs), ours["mean_mm"], 4)
        self.assertAlmostEqual(statistics.pstdev(theirs), ours["sigma_mm"], 4)


if __name__ == "__main__":
    unittest.main()
