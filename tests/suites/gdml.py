#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""gdml.py FOLDER TRISECT [--facets N]

`trisect clash` on every GDML file below FOLDER, one table row for each of its folders: how many files were read, how many
placements there are, what is proved of the pairs, and how many clash. Files that are refused as a whole must stand in
deviations.txt; shapes and placements that are left out are counted. Prints a table in Markdown.

Nobody has said what the answers are: files of detectors do not come with a list of their overlaps. Each report is
compared with itself for what must hold: every pair has one answer.
"""
import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

from run import read_deviations

COLUMNS = ('files', 'refused', 'incomplete', 'compared', 'exact', 'beyond_deviation', 'of_facets', 'clashes',
           'within_deviation')


def report_of(path, trisect, facets, folder):
    """The report, or what the command said instead of one."""
    out = folder / 'report.json'
    out.unlink(missing_ok=True)
    run = subprocess.run([trisect, '--quiet', 'clash', path, '-o', out, '--keep-going', '--facets', str(facets)],
                         capture_output=True, text=True, check=False)
    if run.returncode in (0, 1) and out.exists():
        return json.loads(out.read_text(encoding='utf-8')), ''
    said = run.stderr.strip().splitlines()
    return None, f'exit code {run.returncode}: {said[-1] if said else ""}'


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('trisect', type=pathlib.Path)
    parser.add_argument('--facets', type=int, default=120)
    arguments = parser.parse_args()
    known, tally, problems = read_deviations(), collections.defaultdict(collections.Counter), []
    with tempfile.TemporaryDirectory() as name:
        for path in sorted(arguments.folder.rglob('*.gdml')):
            case = path.relative_to(arguments.folder)
            row = tally[case.parts[0]]
            row['files'] += 1
            report, said = report_of(path, arguments.trisect, arguments.facets, pathlib.Path(name))
            listed = ('gdml', str(case)) in known
            if (report is None) != listed:
                problems.append(f'{case}: {said or "is read, but is listed"}')
            if report is None:
                row['refused'] += 1
                continue
            row['incomplete'] += not report['is_complete']
            pairs = report['geometry']['pairs']
            row.update(pairs)
            answers = sum(pairs[k] for k in ('exact', 'beyond_deviation', 'of_facets', 'clashes'))
            if answers + len(report['unanswered']) != pairs['compared']:
                problems.append(f'{case}: {answers} answers to {pairs["compared"]} pairs')
    print('| files of |', ' | '.join(c.replace('_', ' ') for c in COLUMNS), '|\n|---|' + '---:|' * len(COLUMNS))
    for folder, row in sorted(tally.items()):
        print(f'| {folder} |', ' | '.join(str(row[c]) for c in COLUMNS), '|')
    for problem in problems:
        print('gdml.py:', problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())
