# SPDX-License-Identifier: Apache-2.0
"""Lays out the pages of the site for Sphinx.

    stage.py REPOSITORY STAGE

Pages stay where they are in the repository, and links in them are written for readers there. Each page goes to its place in
the site; links to pages follow, pictures are copied, and a file or folder of the project that a page links to becomes a page of its own under
sources/, with line numbers. A link to what is not there ends the build.
"""

import html
import os
import pathlib
import re
import shutil
import subprocess
import sys

try:
    import pygments
    import pygments.formatters
    import pygments.lexers
except ImportError:
    print("stage.py: python3-pygments is absent: nothing was done")
    sys.exit(77)

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
FENCE = re.compile(r"^(```|~~~)")
PICTURES = {".png", ".svg"}
# Made during the build, beside the pages.
MADE = {"commands.md", "python_reference.md", "results.md", "cpp.md"}


class Site:
    def __init__(self, repository: pathlib.Path, stage: pathlib.Path):
        self.repository = repository
        self.stage = stage
        self.sources: set[str] = set()
        self.places: dict[str, str] = {}
        self.listed: set[str] = set()
        for page in sorted((repository / "docs").glob("*.md")):
            self.places[f"docs/{page.name}"] = f"guide/{page.name}"
        for page in sorted((repository / "docs/site").glob("*.md")):
            self.places[f"docs/site/{page.name}"] = page.name
        for page in sorted((repository / "bench/results").glob("*.md")):
            self.places[f"bench/results/{page.name}"] = f"results/{page.name}"
        self.places["CHANGELOG.md"] = "changelog.md"
        for name in MADE:
            self.places[f"docs/site/{name}"] = name

    def run(self) -> None:
        for page, place in self.places.items():
            if pathlib.Path(place).name not in MADE:
                self.put(page, place)
        for page in self.places:
            if page.startswith("docs/") and page != "docs/site/index.md" and page not in self.listed:
                raise SystemExit(f"{page}: no table of contents in docs/site/index.md has this page")
        self.put_results()
        for source in sorted(self.sources):
            self.put_source(source)

    def put(self, page: str, place: str) -> None:
        text = (self.repository / page).read_text()
        out = self.stage / place
        out.parent.mkdir(parents=True, exist_ok=True)
        lines = []
        fence = None
        for line in text.split("\n"):
            if FENCE.match(line):
                fence = line[3:].strip() if fence is None else None
            elif fence is None:
                line = LINK.sub(lambda m: self.link(m, page, place), line)
            elif fence == "{toctree}" and line and not line.startswith(":"):
                line = self.entry(line, page, place)
            lines.append(line)
        out.write_text("\n".join(lines))

    def entry(self, line: str, page: str, place: str) -> str:
        named = re.fullmatch(r"(.*) <(.*)>", line)
        target = named[2] if named else line
        found = self.resolved(page, target + ".md")
        if found not in self.places:
            raise SystemExit(f"{page}: there is no page {target}")
        self.listed.add(found)
        path = os.path.relpath(self.places[found], os.path.dirname(place) or ".")
        path = path.removesuffix(".md")
        return f"{named[1]} <{path}>" if named else path

    @staticmethod
    def resolved(page: str, target: str) -> str:
        return os.path.normpath(os.path.join(os.path.dirname(page), target))

    def link(self, match: re.Match, page: str, place: str) -> str:
        picture, text, target = match.groups()
        here = os.path.dirname(place) or "."
        if target.startswith("site:"):  # made during the build: pages, and live/ by gallery.py
            made = target.removeprefix("site:").replace("live/", "_live/")
            return f"{picture}[{text}]({os.path.relpath(made, here)})"
        if re.match(r"[a-z]+:|#|/", target):
            return match[0]
        path, _, anchor = target.partition("#")
        found = self.resolved(page, path)
        if found in self.places:
            path = os.path.relpath(self.places[found], here)
            return f"{picture}[{text}]({path}{'#' + anchor if anchor else ''})"
        source = self.repository / found
        if not source.exists():
            raise SystemExit(f"{page}: there is no {target}")
        if source.suffix in PICTURES:
            copy = self.stage / here / source.name
            if not copy.exists():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, copy)
            return f"{picture}[{text}]({source.name})"
        self.sources.add(found)
        href = os.path.relpath(f"sources/{found}.html", here)
        return f'<a href="{html.escape(href)}">{text}</a>'

    def put_results(self) -> None:
        names = sorted(place for place in self.places.values() if place.startswith("results/"))
        lines = ["# Results of measurements", "", "Each table says which command made it, when, and from which commit.", "",
                 "```{toctree}", ":maxdepth: 1"]
        lines += [name.removesuffix(".md") for name in names] + ["```", ""]
        (self.stage / "results.md").write_text("\n".join(lines))

    def put_source(self, source: str) -> None:
        path = self.repository / source
        out = self.stage / "_extra/sources" / (source + ".html")
        out.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            body = self.listing(source, out)
        else:
            text = path.read_text(errors="replace")
            try:
                lexer = pygments.lexers.get_lexer_for_filename(path.name)
            except pygments.util.ClassNotFound:
                lexer = pygments.lexers.get_lexer_by_name("sh" if text.startswith("#!") else "text")
            body = pygments.highlight(
                text, lexer,
                pygments.formatters.HtmlFormatter(linenos="inline", lineanchors="L", noclasses=True))
        out.write_text(
            "<!doctype html><meta charset=utf-8>"
            "<meta name=viewport content='width=device-width,initial-scale=1'>"
            f"<title>{html.escape(source)}</title><style>body{{margin:1em;font-size:14px}}pre{{overflow-x:auto}}</style>"
            f"<h1 style='font-size:1.2em'>{html.escape(source)}</h1>{body}")

    def listing(self, folder: str, out: pathlib.Path) -> str:
        listed = subprocess.run(["git", "ls-files", "--", folder + "/"], cwd=self.repository,
                                capture_output=True, text=True, check=True).stdout.split()
        rows = []
        for file in listed:
            self.put_source(file)
            href = os.path.relpath(self.stage / "_extra/sources" / (file + ".html"), out.parent)
            name = os.path.relpath(file, folder)
            rows.append(f"<li><a href='{html.escape(href)}'>{html.escape(name)}</a>")
        return "<ul>" + "".join(rows) + "</ul>"


if __name__ == "__main__":
    Site(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])).run()
