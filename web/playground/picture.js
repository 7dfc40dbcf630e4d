// SPDX-License-Identifier: Apache-2.0
//
// The picture of triangle meshes, in plain WebGL 2: flat shading, one colour a triangle, a camera that
// turns about the origin.

const vertexSource = `#version 300 es
in vec3 position;
in vec4 color;
uniform mat4 view;
uniform vec3 shift;
out vec3 place;
out vec4 tint;
void main() {
  place = position + shift;
  tint = color;
  gl_Position = view * vec4(place, 1.0);
}`;
const fragmentSource = `#version 300 es
precision highp float;
in vec3 place;
in vec4 tint;
uniform vec3 light;
out vec4 shade;
void main() {
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  float bright = 0.45 + 0.55 * abs(dot(normal, light));
  shade = vec4(tint.rgb * bright * tint.a, tint.a);
}`;

// Okabe and Ito 2008: told apart by all kinds of sight.
export const palette = [[0.337, 0.706, 0.914], [0.902, 0.624, 0], [0, 0.62, 0.451], [0.8, 0.475, 0.655]];

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

export class Picture {
  constructor(canvas) {
    this.canvas = canvas;
    this.turn = -0.9;
    this.tilt = 0.45;
    this.distance = 7;
    this.meshes = [];
    const gl = canvas.getContext('webgl2', { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error('This page needs WebGL 2');
    this.gl = gl;
    const program = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertexSource], [gl.FRAGMENT_SHADER, fragmentSource]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    this.program = program;
    this.place = (name) => gl.getUniformLocation(program, name);
  }

  /** A mesh to draw; colour and opacity are those of `tint(triangle)`. */
  add() {
    const { gl } = this;
    const mesh = { array: gl.createVertexArray(), positions: gl.createBuffer(), colors: gl.createBuffer(), count: 0, shift: [0, 0, 0] };
    gl.bindVertexArray(mesh.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.positions);
    const position = gl.getAttribLocation(this.program, 'position');
    gl.enableVertexAttribArray(position);
    gl.vertexAttribPointer(position, 3, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.colors);
    const color = gl.getAttribLocation(this.program, 'color');
    gl.enableVertexAttribArray(color);
    gl.vertexAttribPointer(color, 4, gl.FLOAT, false, 0, 0);
    this.meshes.push(mesh);
    return mesh;
  }

  fill(mesh, { vertices, faces }, tint) {
    const positions = new Float32Array(3 * faces.length);
    const colors = new Float32Array(4 * faces.length);
    for (let i = 0; i < faces.length; ++i) {
      for (let k = 0; k < 3; ++k) positions[3 * i + k] = vertices[3 * faces[i] + k];
      colors.set(tint(Math.floor(i / 3)), 4 * i);
    }
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.positions);
    gl.bufferData(gl.ARRAY_BUFFER, positions, gl.DYNAMIC_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.colors);
    gl.bufferData(gl.ARRAY_BUFFER, colors, gl.DYNAMIC_DRAW);
    mesh.count = faces.length;
  }

  /** Of the camera: where it is, and its axes to the right, upwards, and away from what it sees. */
  camera() {
    const c = Math.cos(this.tilt);
    const back = [c * Math.cos(this.turn), c * Math.sin(this.turn), Math.sin(this.tilt)];
    const right = unit(cross([0, 0, 1], back));
    return { eye: back.map((x) => x * this.distance), right, up: cross(back, right), back };
  }

  /** A ray through a pixel of the canvas. */
  ray(x, y) {
    const { eye, right, up, back } = this.camera();
    const { clientWidth: w, clientHeight: h } = this.canvas;
    const [u, v] = [((2 * x) / w - 1) * (w / h) * this.lens, (1 - (2 * y) / h) * this.lens];
    return { eye, along: back.map((b, k) => u * right[k] + v * up[k] - b) };
  }
  lens = Math.tan(0.32);

  matrix(aspect) {
    const { eye, right, up, back } = this.camera();
    const [near, far] = [0.1, 100];
    const scale = 1 / this.lens;
    const rows = [
      [...right.map((x) => (x * scale) / aspect), (-dot(right, eye) * scale) / aspect],
      [...up.map((x) => x * scale), -dot(up, eye) * scale],
    ];
    const depth = [...back.map((x) => -x), dot(back, eye)]; // in front of the camera
    const a = (far + near) / (far - near);
    const b = (-2 * far * near) / (far - near);
    rows.push(depth.map((d, k) => a * d + (k === 3 ? b : 0)), depth);
    return new Float32Array([0, 1, 2, 3].flatMap((c) => rows.map((r) => r[c])));
  }

  draw() {
    const { gl, canvas } = this;
    const pixels = globalThis.devicePixelRatio || 1;
    canvas.width = canvas.clientWidth * pixels;
    canvas.height = canvas.clientHeight * pixels;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(this.program);
    gl.uniformMatrix4fv(this.place('view'), false, this.matrix(canvas.width / canvas.height));
    const { right, up, back } = this.camera();
    gl.uniform3fv(this.place('light'), unit(back.map((b, k) => b + 0.4 * up[k] - 0.3 * right[k])));
    for (const mesh of this.meshes) {
      gl.depthMask(!mesh.isGhost);
      gl.uniform3fv(this.place('shift'), mesh.shift);
      gl.bindVertexArray(mesh.array);
      gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
    }
    gl.depthMask(true);
  }
}
