#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""launcher_watch_test.py TRISECT_MPI

A rank that is killed under an mpirun that then waits for a lock for ever, as Open MPI's does now and then: it is killed. One
that waits for something else goes on, and so does one whose rank ended by itself. The mpirun is an interpreter of that name.
Skipped (77) where there is no /proc, or it does not say what processes wait for.
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

TRISECT_MPI = sys.argv[1]
# Starts a rank, says its number, and does not fetch it when it is killed.
LAUNCHER = '''
import subprocess, sys, threading, time
rank = subprocess.Popen(sys.argv[2:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
print(rank.pid, flush=True)
if sys.argv[1] == 'lock':
    lock = threading.Lock()
    lock.acquire()
    lock.acquire()
time.sleep(1000)
'''
LONGER_THAN_IT_WAITS = 12  # seconds


def state(pid, name='stat'):
    try:
        return pathlib.Path(f'/proc/{pid}/{name}').read_text(encoding='ascii')
    except OSError:
        return ''


def children(pid):
    found = []
    for entry in pathlib.Path('/proc').iterdir():
        fields = state(entry.name).rsplit(')', 1)[-1].split() if entry.name.isdigit() else []
        if len(fields) > 1 and int(fields[1]) == pid:
            found.append(int(entry.name))
    return found


class Launched:
    """A rank that waits for a manifest that never comes, and its launcher."""

    def __init__(self, folder, wait, program=None):
        launcher = folder / 'mpirun'
        if not launcher.exists():
            launcher.symlink_to(sys.executable)
            os.mkfifo(folder / 'manifest.json')
        words = program or [TRISECT_MPI, 'clash', str(folder / 'manifest.json'), '-o', str(folder / 'report.json')]
        self.launcher = subprocess.Popen([launcher, '-c', LAUNCHER, wait, *words], stdout=subprocess.PIPE, text=True)
        self.rank = int(self.launcher.stdout.readline())

    def kill_rank(self):
        while not children(self.rank):  # the one that watches
            time.sleep(0.05)
        os.kill(self.rank, signal.SIGKILL)

    def end(self):
        self.launcher.kill()
        self.launcher.communicate()


def can_see():
    with tempfile.TemporaryDirectory() as folder:
        launched = Launched(pathlib.Path(folder), 'lock', ['true'])
        time.sleep(1)
        waits_for = state(launched.launcher.pid, 'wchan')
        launched.end()
    if not waits_for.startswith('futex'):
        print(f'no /proc, or it does not say what processes wait for: "{waits_for}"')
    return waits_for.startswith('futex')


class LauncherWatch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def test_one_that_waits_for_a_lock_is_killed(self):
        launched = Launched(self.folder, 'lock')
        launched.kill_rank()
        self.assertEqual(launched.launcher.wait(100), -signal.SIGKILL)
        launched.end()

    def test_one_that_waits_for_something_else_goes_on(self):
        launched = Launched(self.folder, 'time')
        launched.kill_rank()
        time.sleep(LONGER_THAN_IT_WAITS)
        self.assertIsNone(launched.launcher.poll())
        launched.end()

    def test_one_whose_rank_ended_by_itself_goes_on(self):
        launched = Launched(self.folder, 'lock', [TRISECT_MPI, 'clash', str(self.folder / 'none.json'), '-o', 'r.json'])
        while 'Z' not in state(launched.rank).rsplit(')', 1)[-1].split()[:1]:
            time.sleep(0.05)
        time.sleep(LONGER_THAN_IT_WAITS)
        self.assertIsNone(launched.launcher.poll())
        launched.end()


if __name__ == '__main__':
    if not can_see():
        sys.exit(77)
    sys.exit(not unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result.wasSuccessful())
