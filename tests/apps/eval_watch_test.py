#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""eval_watch_test.py COMMAND

`COMMAND eval --watch` evaluates again after an edit, says what is wrong with a program and goes on, and ends at an
interrupt with exit code 0. So it does with a program in JSON, and with one of OpenSCAD's language and the files that it
includes, where a script stands in for OpenSCAD.
"""
import json
import os
import select
import signal
import subprocess
import sys
import tempfile
import time


def write(name, text):
    """As editors do: another file in its place."""
    with open(name + '.new', 'w', encoding='utf-8') as out:
        out.write(text)
    os.replace(name + '.new', name)


class Watched:
    def __init__(self, command, *words):
        self.process = subprocess.Popen([command, 'eval', *words, '--watch', '--progress', 'none'],
                                        stderr=subprocess.PIPE)
        self.said = b''

    def wait_for(self, word, seconds=120):
        """The line that has the word; lines before it are dropped."""
        deadline = time.monotonic() + seconds
        while True:
            *lines, self.said = self.said.split(b'\n')
            for i, line in enumerate(lines):
                if word.encode() in line:
                    self.said = b'\n'.join([*lines[i + 1:], self.said])
                    return line.decode()
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([self.process.stderr], [], [], left)[0]:
                raise SystemExit(f'eval_watch_test.py: no line with "{word}"')
            data = os.read(self.process.stderr.fileno(), 65536)
            if not data:
                raise SystemExit(f'eval_watch_test.py: ended before a line with "{word}"')
            self.said += data


def volume(command, mesh):
    done = subprocess.run([command, 'info', mesh, '--json'], check=True, capture_output=True)
    return json.loads(done.stdout)['volume']


def program(size, pegs=30):
    peg = 'multmatrix([[1,0,0,%d],[0,1,0,2],[0,0,1,0],[0,0,0,1]]) { cube(size = 1); }\n'
    return 'union() { cube(size = %g);\n%s}\n' % (size, ''.join(peg % (4 * i) for i in range(2, pegs)))


STAND_IN = '''#!/bin/sh
# OpenSCAD -o OUT -d RULE MODEL: the form is what the model and the file beside it say.
printf 'x: \\\\\n\t%s \\\\\n\t%s\n' "$(dirname "$5")/part\\\\ 1.inc" "$5" > "$4"
cat "$5" "$(dirname "$5")/part 1.inc" > "$2"
'''


def watch_json(command, folder):
    model = os.path.join(folder, 'm.json')
    mesh = os.path.join(folder, 'j.off')
    write(model, '{"nodes": [{"node": "cube", "arguments": {"size": 2}}]}')
    watched = Watched(command, model, '-o', mesh)
    watched.wait_for('evaluated in')
    write(model, '{"nodes": [{"node": "cube", "arguments": {"size": 3}}]}')
    watched.wait_for('evaluated in')
    assert volume(command, mesh) == 27
    watched.process.send_signal(signal.SIGINT)
    assert watched.process.wait(60) == 0


def watch_scad(command, folder):
    stand_in = os.path.join(folder, 'openscad')
    write(stand_in, STAND_IN)
    os.chmod(stand_in, 0o755)
    model = os.path.join(folder, 'm.scad')
    part = os.path.join(folder, 'part 1.inc')
    mesh = os.path.join(folder, 's.off')
    write(part, 'cube(size = 1);')
    write(model, 'cube(size = 2);')
    watched = Watched(command, model, '-o', mesh, '--openscad', stand_in)
    watched.wait_for('evaluated in')
    assert volume(command, mesh) == 8
    write(part, 'cube(size = 3);')
    watched.wait_for('evaluated in')
    assert volume(command, mesh) == 27
    write(model, 'cube(size = 4);')
    watched.wait_for('evaluated in')
    assert volume(command, mesh) == 64
    watched.process.send_signal(signal.SIGINT)
    assert watched.process.wait(60) == 0


def main(command):
    with tempfile.TemporaryDirectory() as folder:
        model = os.path.join(folder, 'm.csg')
        mesh = os.path.join(folder, 'm.off')
        write(model, program(2))
        watched = Watched(command, model, '-o', mesh)
        assert 'all of it' in watched.wait_for('evaluated in')
        assert volume(command, mesh) == 36, volume(command, mesh)
        write(model, program(3))
        line = watched.wait_for('evaluated in')
        assert '2 shapes changed' in line, line
        assert volume(command, mesh) == 55
        write(model, 'cube(')
        watched.wait_for('m.csg:')
        assert volume(command, mesh) == 55  # the last one stays
        write(model, program(3, 20))
        watched.wait_for('evaluated in')
        assert volume(command, mesh) == 45
        watched.process.send_signal(signal.SIGINT)
        code = watched.process.wait(60)
        assert code == 0, code
        refused = subprocess.run([command, 'eval', '-', '-o', mesh, '--watch'], input=b'cube(size = 1);', check=False,
                                 capture_output=True)
        assert refused.returncode == 2, refused.returncode
        watch_json(command, folder)
        watch_scad(command, folder)
    return 0


if __name__ == '__main__':
    sys.exit(main(os.path.abspath(sys.argv[1])))
