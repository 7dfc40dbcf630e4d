// SPDX-License-Identifier: Apache-2.0
//
// jscad_cases.js FOLDER: the booleans that JSCAD's own tests do, as lines of JSON.
//
// Their test programs run as they are, from FOLDER (packages/modeling of jscad/OpenJSCAD.org): `ava` is stood in for, and
// union, subtract, intersect and scission write down what they take and what they give.
'use strict'
const Module = require('module')
const path = require('path')

const source = path.join(path.resolve(process.argv[2]), 'src')
const folder = path.join(source, 'operations', 'booleans')
const load = Module._load
const geom3 = require(path.join(source, 'geometries', 'geom3'))
let running = ''

const run = (name, body) => {
  running = name
  const yes = () => true
  const notThrows = Object.assign((work) => work(), { skip: yes })
  body({ is: yes, true: yes, false: yes, not: yes, notThrows, deepEqual: yes })
}
run.only = run
run.skip = () => {}

const recorded = (operation, work) => (...operands) => {
  const result = work(...operands)
  const all = operands.flat(Infinity)
  if (all.every((g) => geom3.isA(g))) {
    const results = [result].flat(Infinity)
    console.log(JSON.stringify({ test: running, operation, operands: all.map(geom3.toPoints), results: results.map(geom3.toPoints) }))
  }
  return result
}

Module._load = function (request, parent, isMain) {
  if (request === 'ava') return run
  const loaded = load(request, parent, isMain)
  if (request !== './index' || path.dirname(parent.filename) !== folder || !parent.filename.endsWith('.test.js')) return loaded
  return Object.fromEntries(Object.entries(loaded).map(([name, work]) => [name, recorded(name, work)]))
}

for (const name of ['intersectGeom3', 'subtractGeom3', 'unionGeom3', 'scission']) require(path.join(folder, name + '.test.js'))
