# SPDX-License-Identifier: Apache-2.0
"""Follows every link between the pages of a site, to its file and its anchor.

    check_links.py FOLDER

Prints links that lead nowhere; exits with 1 if there are any. Links to other sites are not followed: nothing here needs a
network.
"""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, text: str):
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            if name in ("id", "name") and value:
                self.anchors.add(value)


def main(folder: pathlib.Path) -> int:
    pages = {path: Page(path.read_text(errors="replace")) for path in folder.rglob("*.html")
             if folder / "cpp" not in path.parents}
    broken = 0
    count = 0
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            count += 1
            target = path if not parts.path else (path.parent / urllib.parse.unquote(parts.path)).resolve()
            there = target.exists()
            if there and parts.fragment and target in pages:
                there = urllib.parse.unquote(parts.fragment) in pages[target].anchors
            if not there:
                broken += 1
                print(f"{path.relative_to(folder)}: {link} leads nowhere")
    print(f"{len(pages)} pages, {count} links between them, {broken} lead nowhere")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
