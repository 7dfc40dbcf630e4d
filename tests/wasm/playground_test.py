#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The playground in a headless browser.

    tests/wasm/playground_test.py FOLDER [--screenshot FILE]

FOLDER is the one that scripts/build-wasm makes. Drives the page by what it has in `window.playground`: relations and
volumes of moved boxes, a program of OpenSCAD, a drag by the mouse. Exits with 77 where page or browser are missing.
"""

import argparse
import functools
import html
import http.server
import json
import pathlib
import re
import shutil
import subprocess
import sys
import threading

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# The time of the page is virtual: it passes at once where the page only waits, as for the module to be compiled, which
# takes real time. So there is plenty of it.
OPTIONS = (
    "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1000,700",
    "--hide-scrollbars", "--virtual-time-budget=900000",
)

# Runs in the page and leaves what it found in an element.
DRIVER = """
<script type="module">
  const until = async (test) => { while (!test()) await new Promise((done) => setTimeout(done, 20)); };
  await until(() => !document.title.endsWith('playground'));
  const found = [];
  const p = window.playground;
  const choose = (id, value) => {
    const field = document.getElementById(id);
    field.value = value;
    field.dispatchEvent(new Event('change'));
  };
  choose('second', 'box');
  choose('operation', 'intersection');
  for (const at of [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2.25, 0, 0]]) {
    p.at = at;
    p.update();
    found.push(p.state());
  }
  choose('second', 'ball');
  choose('operation', 'difference');
  document.getElementById('evaluate').click();
  found.push(p.state());
  p.evaluate('cube(');
  found.push(p.state());
  p.at = [1, -1, 0.5];
  p.update();
  const canvas = document.getElementById('view');
  const event = (type, x, y) => canvas.dispatchEvent(new PointerEvent(type, { clientX: x, clientY: y, pointerId: 1 }));
  canvas.setPointerCapture = () => {};
  const grip = () => {
    for (let y = 50; y < canvas.clientHeight - 50; y += 20)
      for (let x = 50; x < canvas.clientWidth - 50; x += 20) if (p.grab(x, y)) return [x, y];
    return null;
  };
  const [x, y] = grip();
  event('pointerdown', x, y);
  event('pointermove', x + 60, y);
  event('pointerup', x + 60, y);
  found.push(p.state());
  const answer = document.createElement('pre');
  answer.id = 'answer';
  answer.textContent = JSON.stringify(found);
  answer.hidden = true;
  document.body.append(answer);
</script>
"""


class Handler(http.server.SimpleHTTPRequestHandler):
    """The folder, and the page with the driver under another name."""

    extensions_map = {".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", "": "text/plain"}

    def do_GET(self):
        if self.path != "/driven.html":
            return super().do_GET()
        page = (pathlib.Path(self.directory) / "index.html").read_text()
        body = page.replace("</body>", DRIVER + "</body>").encode()
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


def browse(browser, address, *more):
    done = subprocess.run([browser, *OPTIONS, *more, address], capture_output=True, text=True, timeout=240, check=True)
    return done.stdout


def check(found):
    boxes, program, wrong, dragged = found[:4], found[4], found[5], found[6]
    relations = [s["relation"] for s in boxes]
    if relations != ["equal", "overlapping", "touching", "disjoint"]:
        raise SystemExit(f"relations {relations}")
    if [s["volume"] for s in boxes] != [8, 4, 0, 0]:
        raise SystemExit(f"volumes {[s['volume'] for s in boxes]}")
    if program["error"] or not 0 < program["volume"] < 8:
        raise SystemExit(f"the program's solid: {program}")
    if "text:1" not in wrong["error"]:
        raise SystemExit(f"a program that ends early: {wrong['error']!r}")
    if dragged["at"] == [1, -1, 0.5] or dragged["error"]:
        raise SystemExit(f"a drag by sixty pixels: {dragged}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--screenshot", type=pathlib.Path)
    arguments = parser.parse_args()
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None or not (arguments.folder / "trisect.wasm").exists():
        print("playground_test: no browser, or no page: scripts/build-wasm")
        return 77
    server = http.server.ThreadingHTTPServer(
        ("127.0.0.1", 0), functools.partial(Handler, directory=str(arguments.folder))
    )
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_address[1]}"
    document = browse(browser, f"{address}/driven.html", "--dump-dom")
    answer = re.search(r'<pre id="answer"[^>]*>(.*?)</pre>', document, re.DOTALL)
    if answer is None:
        title = re.search(r"<title>(.*?)</title>", document, re.DOTALL)
        error = re.search(r'id="error"[^>]*>(.*?)</p>', document, re.DOTALL)
        raise SystemExit(f"no answer: {title and title.group(1)}, {error and html.unescape(error.group(1))}")
    found = json.loads(html.unescape(answer.group(1)))
    check(found)
    print("playground: relations, volumes, program and drag are right; one step took", found[-1]["time"])
    if arguments.screenshot:
        browse(browser, f"{address}/index.html", f"--screenshot={arguments.screenshot}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
