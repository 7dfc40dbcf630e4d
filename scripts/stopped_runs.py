# SPDX-License-Identifier: Apache-2.0
"""Commands that are killed at random times and gone on with."""
import collections
import contextlib
import os
import pathlib
import signal
import subprocess
import tempfile
import time


PATIENCE = 20  # seconds


def with_ranks(count, command):
    root = ['--allow-run-as-root'] if os.geteuid() == 0 else []
    return ['mpirun', *root, '--oversubscribe', '-n', str(count), *command]


def seconds_of(command):
    begin = time.monotonic()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return time.monotonic() - begin


def children_of(pid):
    found = []
    for entry in pathlib.Path('/proc').iterdir():
        try:
            if entry.name.isdigit() and int((entry / 'stat').read_text().rsplit(')', 1)[1].split()[1]) == pid:
                found.append(int(entry.name))
        except (OSError, IndexError):
            continue  # it has ended
    return found


def is_running(pid):
    try:
        return pathlib.Path(f'/proc/{pid}/stat').read_text().rsplit(')', 1)[1].split()[0] != 'Z'
    except OSError:
        return False


class Killer:
    """Kills by chance, and counts whom."""

    def __init__(self, ranks, choice):
        self.ranks, self.choice, self.killed = ranks, choice, collections.Counter()

    def has_killed(self, kills):
        """So many of each kind."""
        kinds = ('mpirun', 'a rank') if self.ranks else ('the command',)
        return all(self.killed[kind] >= kills for kind in kinds)

    def kill_one(self, process):
        """Kills the process or one of its ranks, and waits until all of them have ended."""
        children = children_of(process.pid) if self.ranks else []
        victim = self.choice.choice(children) if children and self.choice.random() < 0.5 else process.pid
        self.killed['mpirun' if self.ranks and victim == process.pid else
                    'a rank' if self.ranks else 'the command'] += 1
        with contextlib.suppress(ProcessLookupError):  # it has just ended
            os.kill(victim, signal.SIGKILL)
        try:
            process.wait(PATIENCE)
            if victim != process.pid and process.returncode == -signal.SIGKILL:
                self.killed['mpirun that waited for itself and was ended'] += 1
        except subprocess.TimeoutExpired:
            self.killed['mpirun that did not end'] += 1
            process.kill()
            process.wait()
        while any(map(is_running, children)):
            time.sleep(0.01)

    def run_to_the_end(self, command, whole):
        """Again and again, until one run of about `whole` seconds is not killed; what it wrote to its stderr."""
        for _ in range(1000):
            with tempfile.TemporaryFile('w+') as said:
                process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=said)
                try:
                    process.wait(self.choice.uniform(0.05, 1.1) * whole)
                    said.seek(0)
                    return said.read()
                except subprocess.TimeoutExpired:
                    self.kill_one(process)
        return 'never ended'

    def __str__(self):
        return ', '.join(f'{number} of {name}' for name, number in self.killed.items())
