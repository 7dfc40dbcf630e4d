#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""eval_progress_test.py COMMAND

`COMMAND eval` on a terminal says which node is evaluated, by name and line, and how many are done; an interrupt within
a node that takes long ends it with exit code 6 and without output.
"""
import errno
import os
import pty
import select
import signal
import subprocess
import sys
import tempfile
import time

# The sum of two shells: within the limit of pieces, and far longer than this waits.
PROGRAM = '''cube(size = 1);
union() {
  minkowski() {
    difference() { sphere(r = 90, $fn = 20); sphere(r = 80, $fn = 20); }
    difference() { sphere(r = 3, $fn = 6); sphere(r = 2, $fn = 6); }
  }
}
'''


def read_some(terminal):
    """What came next, or nothing where the process has ended: then a terminal has no writer, which is EIO."""
    try:
        return os.read(terminal, 65536)
    except OSError as error:
        if error.errno != errno.EIO:
            raise
        return b''


def wait_for(terminal, word, seconds=120):
    said = b''
    deadline = time.monotonic() + seconds
    while word.encode() not in said:
        left = deadline - time.monotonic()
        ready = left > 0 and select.select([terminal], [], [], left)[0]
        more = read_some(terminal) if ready else b''
        if not more:
            raise SystemExit(f'eval_progress_test.py: no "{word}" in {said[-500:]!r}')
        said += more
    return said.decode(errors='replace')


def main(command):
    with tempfile.TemporaryDirectory() as folder:
        model = os.path.join(folder, 'm.csg')
        with open(model, 'w', encoding='utf-8') as out:
            out.write(PROGRAM)
        mesh = os.path.join(folder, 'm.off')
        terminal, end = pty.openpty()
        process = subprocess.Popen([command, 'eval', model, '-o', mesh, '--progress', 'bar', '--max-seconds', '300'],
                                   stderr=end)
        os.close(end)
        said = wait_for(terminal, 'evaluate: minkowski, line 3 (')
        assert ' of 9 nodes done)' in said, said
        process.send_signal(signal.SIGINT)
        code = process.wait(60)
        assert code == 6, code
        assert os.listdir(folder) == ['m.csg'], os.listdir(folder)
        os.close(terminal)
    return 0


if __name__ == '__main__':
    sys.exit(main(os.path.abspath(sys.argv[1])))
