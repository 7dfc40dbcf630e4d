#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""csg_seeds CORPUS FOLDER LENGTH

Copies the .csg files below a folder into a corpus of fuzz_csg, with the byte in front that says that they are text. Of
longer files than the length each call at the outermost level is one input.
"""
import hashlib
import pathlib
import sys


def calls(text):
    """The text of each call at the outermost level."""
    depth, begin, out = 0, 0, []
    for i, c in enumerate(text):
        depth += (c in '({[') - (c in ')}]')
        if depth == 0 and c in ';}':
            out.append(text[begin:i + 1])
            begin = i + 1
    return out


def parts(text, length):
    """Calls that are short enough; of others their children."""
    if len(text) < length:
        return [text]
    out = []
    for call in calls(text):
        if len(call) < length:
            out.append(call)
        elif '{' in call:
            out += parts(call[call.index('{') + 1:call.rindex('}')], length)
    return out


def main():
    corpus, folder, length = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), int(sys.argv[3])
    for path in sorted(folder.rglob('*.csg')):
        for part in parts(path.read_text(errors='replace'), length):
            data = b'\0' + part.strip().encode()
            if len(data) > 1:
                (corpus / hashlib.sha1(data).hexdigest()).write_bytes(data)


if __name__ == '__main__':
    main()
