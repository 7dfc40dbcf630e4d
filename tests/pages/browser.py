# SPDX-License-Identifier: Apache-2.0
"""A headless Chromium that opens pages and reads what they answer."""

import html
import json
import re
import shutil
import subprocess
import urllib.parse

NAMES = ("chromium", "chromium-browser", "google-chrome")
OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--window-size=1000,750",
    "--hide-scrollbars",
    "--virtual-time-budget=20000",
)


def find_browser():
    return next((b for b in NAMES if shutil.which(b)), None)


def browse(browser, page, *more, call=""):
    address = page.resolve().as_uri() + call
    done = subprocess.run(
        [browser, *OPTIONS, *more, address], capture_output=True, text=True, timeout=240, check=True
    )
    return done.stdout


def fragment(function, *arguments):
    """What makes a page call a function of window.trisect."""
    return "#" + urllib.parse.urlencode({"call": function, "with": json.dumps(arguments)})


def ask(browser, page, function, *arguments):
    """What a function of window.trisect gives, in a fresh browser."""
    document = browse(browser, page, "--dump-dom", call=fragment(function, *arguments))
    title = re.search(r"<title>(.*?)</title>", document, re.DOTALL).group(1)
    if not title.endswith(": ready"):
        raise SystemExit(f"{page.name}: {html.unescape(title)}")
    answer = re.search(r'<pre id="answer"[^>]*>(.*?)</pre>', document, re.DOTALL).group(1)
    return json.loads(html.unescape(answer))


def picture(browser, page, file, function="", *arguments, dark=False):
    call = fragment(function, *arguments) if function else ""
    more = ["--blink-settings=preferredColorScheme=0"] if dark else []
    browse(browser, page, f"--screenshot={file.resolve()}", *more, call=call)
