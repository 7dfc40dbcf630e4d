// SPDX-License-Identifier: Apache-2.0
#include "page_style.h"

namespace trisect::app {

const char* const page_start = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Solid</title>
<style>
)html";

const char* const page_style =
    R"html(:root { color-scheme: light dark; --back: #eef1f5; --panel: #fffffff0; --ink: #1d2733;
  --line: #cfd6df; --soft: #5a6776; --mark: #0b5394; --alarm: #b53d00; --chosen: #dbe9f6; }
@media (prefers-color-scheme: dark) {
  :root { --back: #20262e; --panel: #2b333df0; --ink: #e8edf3; --line: #46505c; --soft: #a5b1be;
    --mark: #7cc0f0; --alarm: #ff9d5c; --chosen: #3a4a5c; }
}
html, body { margin: 0; height: 100%; overflow: hidden; background: var(--back); color: var(--ink);
  font: 14px/1.45 system-ui, sans-serif; }
#view { position: absolute; inset: 0; width: 100%; height: 100%; display: block; cursor: grab;
  touch-action: none; }
#panel { position: absolute; top: 10px; left: 10px; width: min(320px, 80vw); max-height: 94%;
  overflow: auto; background: var(--panel); border: 1px solid var(--line); border-radius: 6px;
  padding: 10px 14px; box-sizing: border-box; }
#panel h1 { font-size: 16px; margin: 0 0 2px; overflow-wrap: anywhere; }
#panel h2 { font-size: 14px; margin: 10px 0 2px; }
#panel ul { list-style: none; padding: 0; margin: 8px 0; }
#panel li { overflow-wrap: anywhere; }
#panel li i { display: inline-block; width: 12px; height: 12px; margin-right: 7px;
  border-radius: 3px; border: 1px solid #0005; vertical-align: -1px; }
#panel label { display: flex; gap: 8px; align-items: center; margin: 3px 0; }
#panel input[type=range] { flex: 1; min-width: 0; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; margin: 8px 0 0; font: 12px/1.4 ui-monospace,
  monospace; }
#item { position: absolute; bottom: 10px; left: 10px; background: var(--panel); padding: 2px 8px;
  border-radius: 4px; }
#bar:not(:empty) ~ #item { bottom: 90px; }
#item:empty, pre:empty { display: none; }
details { margin-top: 8px; }
:focus-visible { outline: 2px solid var(--mark); outline-offset: 1px; }
#view:focus-visible { outline-offset: -3px; }
#summary { color: var(--soft); }
#findings { max-height: 34vh; overflow: auto; margin: 4px 0; border: 1px solid var(--line);
  border-radius: 4px; }
#findings [role=option] { padding: 3px 8px; cursor: pointer; border-left: 4px solid transparent; }
#findings [role=option][aria-selected=true] { background: var(--chosen); border-color: var(--mark); }
#findings [role=option] b { font-weight: 600; margin-right: 6px; }
#finding { margin: 4px 0 0; overflow-wrap: anywhere; }
.bodies { max-height: 26vh; overflow: auto; }
.bodies select { margin-left: auto; }
.bodies span { overflow-wrap: anywhere; }
.error { color: var(--alarm); } .note { color: var(--mark); }
#bar:empty { display: none; }
#bar { position: absolute; left: 50%; bottom: 10px; transform: translateX(-50%);
  width: min(720px, calc(100vw - 20px)); background: var(--panel); border: 1px solid var(--line);
  border-radius: 6px; padding: 6px 12px; box-sizing: border-box; }
#bar .row { display: flex; gap: 10px; align-items: center; }
#bar input[type=range] { flex: 1; min-width: 0; }
#bar .track { position: relative; flex: 1; display: flex; }
#bar .track i { position: absolute; top: -3px; bottom: -3px; width: 3px; background: var(--alarm);
  pointer-events: none; }
#moment { font-variant-numeric: tabular-nums; }
button { font: inherit; color: inherit; background: var(--back); border: 1px solid var(--line);
  border-radius: 4px; padding: 1px 10px; cursor: pointer; }
button:disabled { opacity: 0.5; cursor: default; }
select, input[type=text] { font: inherit; color: inherit; background: var(--back);
  border: 1px solid var(--line); border-radius: 4px; }
.steps { margin: 4px 0; padding: 0 0 0 26px; max-height: 30vh; overflow: auto; font-size: 13px; }
.steps li { cursor: pointer; padding-left: 2px; }
.steps li[aria-current=step] { background: var(--chosen); }
table.costs { border-collapse: collapse; width: 100%; font-size: 13px; font-variant-numeric: tabular-nums; }
table.costs td, table.costs th { text-align: right; padding: 0 3px; font-weight: normal; }
table.costs td:first-child, table.costs th:first-child { text-align: left; }
table.costs tr[aria-selected=true] { background: var(--chosen); }
table.costs tr { cursor: pointer; }
svg.chart { width: 100%; height: 74px; display: block; }
@media (max-width: 640px) { #panel { width: calc(100vw - 20px); max-height: 42%; } }
@media (prefers-reduced-motion: reduce) { * { transition: none; } }
)html";

}  // namespace trisect::app
