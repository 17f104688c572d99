#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One optimisation has the same bits for 1, 2 and 4 processes, and failures are told once.
run.py MPIEXEC PROGRAM"""
import os
import subprocess
import sys
import unittest

PROGRAM = sys.argv.pop()
MPIEXEC = sys.argv.pop()


def run(processes, how):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    command = [MPIEXEC, "--oversubscribe", "-np", str(processes), PROGRAM, how]
    if processes == 0:
        command = [PROGRAM, how]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return done.stdout


class Processes(unittest.TestCase):
    def test_same_bits_for_any_number_of_processes(self):
        for how in ("evaluation", "islands"):
            alone = run(0, how)
            self.assertRegex(alone, "^[0-9a-f]{16} [0-9a-f]{16}\n$")
            for processes in (1, 2, 4):
                self.assertEqual(run(processes, how), alone, f"{how} with {processes} processes")

    def test_a_failure_is_told_once(self):
        for processes in (0, 2, 4):
            self.assertEqual(run(processes, "fail"), "refused: a gene of more than 0.9 is too much\n")
        self.assertEqual(run(3, "input"), "refused: cell.toml: cannot be read\n")


if __name__ == "__main__":
    unittest.main()
