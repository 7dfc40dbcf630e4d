#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""manual_test.py COMMAND FOLDER

Manual pages and completion in FOLDER have every sub-command and every option that COMMAND's --help lists, and no other;
man finds nothing to warn of; and shells complete: bash, and zsh and fish where they are installed.
"""
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import time

OPTION = re.compile(r'^  (-[A-Za-z]|--[a-z-]+)(?:,(--[a-z-]+))?', re.MULTILINE)
FRESH = {'PATH': '/usr/bin:/bin', 'TERM': 'dumb', 'LC_ALL': 'C.UTF-8', 'PS1': '$ ', 'HOME': '/nonexistent'}

problems = []


def expect(holds, says):
    if not holds:
        problems.append(says)


def output_of(*words, **more):
    return subprocess.run(words, check=True, capture_output=True, text=True, **more).stdout


def options_in(text):
    return {name for match in OPTION.finditer(text) for name in match.groups() if name}


def listed(command):
    """Options of the program and of each sub-command, by its name."""
    text = output_of(command, '--help')
    names = re.findall(r'^  ([a-z][a-z-]*)\s', text[text.index('Subcommands:'):], re.MULTILINE)
    return options_in(text), {name: options_in(output_of(command, name, '--help')) for name in names}


def check_page(page, options):
    text = page.read_text(encoding='utf-8').replace('\\-', '-')
    found = {name for tag in re.findall(r'^\.TP\n(\\fB-.*)$', text, re.MULTILINE)
             for name in re.findall(r'\\fB(-[^\\]*)\\fR', tag)}
    expect(found == options, f'{page.name}: differs from --help: {sorted(found ^ options)}')
    shown = subprocess.run(['man', '--warnings', '-E', 'UTF-8', '-l', str(page)], capture_output=True, text=True,
                           env=FRESH | {'MANWIDTH': '100'}, check=False)
    expect(shown.returncode == 0 and not shown.stderr, f'{page.name}: man says: {shown.stderr}')


def bash_words(folder, words):
    """What bash would offer for the last word."""
    script = f'source {folder}/bash/trisect; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _trisect; ' \
             'printf "%s\\n" "${COMPREPLY[@]}"'
    return set(output_of('bash', '-c', script, 'bash', *words).split())


def check_bash(folder, common, commands):
    expect(bash_words(folder, ['trisect', '']) == set(commands), 'bash: sub-commands differ')
    expect(bash_words(folder, ['trisect', '-']) == common, 'bash: common options differ')
    for name, own in commands.items():
        offered = bash_words(folder, ['trisect', name, '-'])
        expect(offered == own | common, f'bash: {name}: {sorted(offered ^ (own | common))}')
    for words, offers in (
            (['union', '--winding', ''], {'positive', 'nonzero'}),
            (['union', '--winding', '=', 'p'], {'positive'}),
            (['--threads', '2', 'render', '--up', ''], {'x', 'y', 'z'}),
            (['--threads', '=', '2', 'render', '--up', ''], {'x', 'y', 'z'}),
            (['verify', 'un'], {'union'}),
            (['check', '--places', ''], set()),
            (['--format', 'stl'], {'stl', 'stl-ascii', 'stl-binary'}),
            (['info', 'man1/trisect-in'], {'man1/trisect-info.1', 'man1/trisect-interfere.1',
                                           'man1/trisect-intersection.1'})):
        found = bash_words('.', ['trisect', *words])
        expect(found == offers, f'bash: {words} gives {sorted(found)}')


def typed(shell, prepare, keys, answer):
    """Whether a shell on a terminal, after some lines, completes what is typed to what holds the answer."""
    child, terminal = pty.fork()
    if child == 0:
        os.execve(shutil.which(shell[0]), shell, FRESH)
    shown = ''
    os.write(terminal, (prepare + '\n').encode())
    end = time.monotonic() + 20
    is_typed = False
    while time.monotonic() < end and answer not in shown:
        if select.select([terminal], [], [], 0.5)[0]:
            try:
                shown += os.read(terminal, 4096).decode(errors='replace')
            except OSError:
                break
        elif not is_typed:  # it is quiet: the lines are done
            is_typed = True
            os.write(terminal, keys.encode())
    os.write(terminal, b'\x03exit\n')
    os.close(terminal)
    os.waitpid(child, 0)
    return answer in shown


def check_shells(folder, commands):
    expect(typed(['bash', '--norc', '--noprofile', '-i'], f'source {folder}/bash/trisect', 'trisect rend\t--backg\t',
                 'trisect render --background '), 'bash on a terminal does not complete')
    if shutil.which('zsh'):
        prepare = f'fpath=({folder}/zsh $fpath); autoload -U compinit; compinit -D'
        expect(typed(['zsh', '-f', '-i'], prepare, 'trisect rend\t--backg\t', '--background'),
               'zsh on a terminal does not complete')
    if shutil.which('fish'):
        for words, offers in (('trisect ', set(commands)), ('trisect union --winding ', {'positive', 'nonzero'})):
            found = output_of('fish', '-N', '-c', f'source {folder}/fish/trisect.fish; complete -C "{words}"',
                              env=FRESH, cwd=folder / 'zsh')
            names = {line.split('\t')[0] for line in found.splitlines()}
            expect(names == offers, f'fish: "{words}" gives {sorted(names)}')
        for name, own in commands.items():
            found = output_of('fish', '-N', '-c',
                              f'source {folder}/fish/trisect.fish; complete -C "trisect {name} --"', env=FRESH)
            missing = {o for o in own if o.startswith('--')} - {line.split('\t')[0] for line in found.splitlines()}
            expect(not missing, f'fish: {name} lacks {sorted(missing)}')


def main(command, folder):
    common, commands = listed(command)
    expect(len(common) > 10 and len(commands) > 10, '--help cannot be read')
    pages = {page.name for page in (folder / 'man1').iterdir()}
    if 'trisect-mpi.1' in pages:  # a program of its own, where there is MPI
        pages.remove('trisect-mpi.1')
        check_page(folder / 'man1' / 'trisect-mpi.1', set())
    expect(pages == {'trisect.1'} | {f'trisect-{name}.1' for name in commands}, f'pages: {sorted(pages)}')
    check_page(folder / 'man1' / 'trisect.1', common)
    for name, own in commands.items():
        check_page(folder / 'man1' / f'trisect-{name}.1', own)
        zsh = (folder / 'zsh' / '_trisect').read_text(encoding='utf-8')
        for option in own | common:
            expect(f"'*{option}[" in zsh, f'zsh: {option} is missing')
    os.chdir(folder)
    check_bash(folder, common, commands)
    check_shells(folder, commands)
    for problem in problems:
        print(f'manual_test.py: {problem}', file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    if not shutil.which('man') or not shutil.which('bash'):
        print('manual_test.py: man or bash is not installed')
        sys.exit(77)
    sys.exit(main(os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()))
