# SPDX-License-Identifier: Apache-2.0
"""Runs the built program as a user does. The first word of the command line names it."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else "build/bin/asterism"


class ProgramTest(unittest.TestCase):
    """A folder of its own, and the program run in it."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.at = Path(self._folder.name)

    def tearDown(self):
        self._folder.cleanup()

    def run_program(self, *words, status=0, before=(), **options):
        done = subprocess.run([*before, PROGRAM, *map(str, words)], capture_output=True, text=True, timeout=120, **options)
        if status is not None:
            self.assertEqual(done.returncode, status, f"{words}: {done.stderr}")
        return done

    def refused(self, part, *words, status=2, **options):
        """The program ends with `status` and its last line on standard error holds `part`."""
        done = self.run_program(*words, status=status, **options)
        lines = done.stderr.strip().splitlines()
        self.assertIn(part, lines[-1])
        self.assertEqual(done.stdout if status == 2 and "centres in" not in done.stdout else "", "")
        return done
