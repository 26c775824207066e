// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The page of a run: texts, numbers, plots on a canvas, and the view by WebGL 2. report.py fills in the data.
'use strict';

const data = JSON.parse(document.getElementById('data').textContent);
const at = id => document.getElementById(id);
const css = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

const VIRIDIS = [[86, 36, 108], [77, 54, 128], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
const HEAT = [[70, 74, 84], [105, 78, 62], [140, 84, 40], [185, 92, 10], [222, 110, 0], [238, 142, 42], [247, 178, 80], [252, 214, 130], [255, 243, 190]];
const COLOURS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#8a8f98', '#a89500', '#7b4fb5', '#b8524f'];

// What the user has chosen stays when the page loads again.
const KEY = 'lsdcd report ' + location.pathname;
const HOME = {turn: -1.2, tilt: 0.25, zoom: 1, shift: [0, 0], cut: 0};
const state = {...HOME, frame: -1, field: '', colour: 'speed', log: false, hidden: [], latest: true};
try {
  Object.assign(state, JSON.parse(sessionStorage.getItem(KEY) || '{}'));
} catch (error) { /* a browser that keeps nothing */ }

function save() {
  try {
    sessionStorage.setItem(KEY, JSON.stringify(state));
  } catch (error) { /* likewise */ }
}

// A number with as many digits as a reader needs.
function text(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '-';
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e6 || size < 1e-3 ? value.toExponential(digits - 1).replace('e+', 'e') : String(+value.toPrecision(digits));
}

// A value and its error, as many digits as the error leaves.
function withError(value, error) {
  if (!error || !Number.isFinite(error)) return text(value);
  const digits = Math.ceil(Math.log10(Math.max(Math.abs(value), error) / error)) + 2;
  return `${text(value, Math.min(Math.max(digits, 2), 8))} ± ${text(error, 2)}`;
}

function made(tag, words, properties = {}) {
  return Object.assign(document.createElement(tag), {textContent: words}, properties);
}

async function unpacked(packed, Type) {
  const bytes = Uint8Array.from(atob(packed), c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Type(await new Response(stream).arrayBuffer());
}

// ---- texts and numbers

function showTexts() {
  const of = data.target > data.step && !data.done ? ` of ${data.target} (${Math.floor(100 * data.step / data.target)} %)` : '';
  at('title').textContent = data.title;
  at('state').textContent = `${data.state}, step ${data.step}${of}, read ${data.written} from ${data.log}`;
  for (const [kind, words] of data.checks) at('checks').append(made('li', words, {className: kind}));
  at('told').firstChild.textContent = data.n_warnings ? `Warnings of the log (${data.n_warnings})` : 'Warnings of the log: none';
  at('warnings').textContent = data.warnings.join('\n');
  at('notes').textContent = data.notes.join('\n') || 'Nothing was left out.';
  at('settings').textContent = [...data.settings, '', ...data.facts].join('\n');
}

function showNumbers() {
  at('window').textContent = data.window;
  for (const n of data.numbers) {
    const row = at('numbers').insertRow(), head = row.appendChild(made('th', n.name, {scope: 'row'}));
    head.append(made('small', [n.owner, n.meaning].filter(Boolean).join(': ')));
    const cell = row.insertCell();
    if (n.least === n.most) cell.append(`${text(n.last)} ${n.unit}`);
    else if (n.rate === null) cell.append(`${withError(n.mean, n.error)} ${n.unit}`, made('small', `from ${text(n.least)} to ${text(n.most)}`));
    else cell.append(`${text(n.last)} ${n.unit}`, made('small', `${withError(n.rate, n.rate_error)} ${n.rate_unit}`));
  }
}

// ---- plots

const charts = [];
let cursor = null;    // the time under the pointer

// Steps of an axis that are 1, 2 or 5 times a power of ten.
function ticks(least, most, wanted) {
  const rough = (most - least) / wanted, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find(k => k * power >= rough) * power, found = [];
  for (let k = Math.ceil(least / step - 1e-9); k * step <= most + 1e-9 * step; k++) found.push(k * step);
  return found;
}

class Chart {
  // series: {name, x, mean, low, high}, of numbers in order of x. bars: each is a bin, from x to x of the next.
  constructor(parent, title, unit, series, {bars = false, xName = ''} = {}) {
    Object.assign(this, {title, unit, series, bars, xName});
    const box = parent.appendChild(made('section', '', {className: 'plot'}));
    box.append(made('h2', unit ? `${title}, ${unit}` : title));
    this.canvas = box.appendChild(document.createElement('canvas'));
    this.legend = box.appendChild(made('div', '', {className: 'legend'}));
    this.values = series.map((s, k) => this.entry(s, k));
    for (const [name, set] of [['pointermove', e => this.timeAt(e.offsetX)], ['pointerleave', () => null]])
      this.canvas.addEventListener(name, e => {
        if (this.bars) return;
        cursor = set(e);
        for (const chart of charts) chart.draw();
      });
    charts.push(this);
    this.draw();
  }

  entry(series, k) {
    const key = `${this.title}/${series.name}`, button = this.legend.appendChild(made('button', ''));
    button.append(made('b', '', {style: `background:${COLOURS[k % COLOURS.length]}`}), series.name);
    const value = button.appendChild(document.createElement('output'));
    series.shown = !state.hidden.includes(key);
    button.setAttribute('aria-pressed', series.shown);
    button.onclick = () => {
      series.shown = !series.shown;
      button.setAttribute('aria-pressed', series.shown);
      state.hidden = series.shown ? state.hidden.filter(name => name !== key) : [...state.hidden, key];
      save();
      this.draw();
    };
    return value;
  }

  timeAt(x) {
    const [least, most] = this.range;
    return least + (x - this.left) / this.width * (most - least);
  }

  // The bounds of what is shown: those of x, then those of y.
  bounds() {
    const b = [Infinity, -Infinity, Infinity, -Infinity];
    for (const s of this.series.filter(one => one.shown))
      for (let k = 0; k < s.x.length; k++) {
        if (!Number.isFinite(s.mean[k])) continue;
        const x = this.bars ? Math.log10(s.x[k]) : s.x[k];
        b[0] = Math.min(b[0], x);
        b[1] = Math.max(b[1], this.bars ? x + 0.1 : x);
        if (!this.bars || s.mean[k] > 0) {
          b[2] = Math.min(b[2], this.bars ? Math.log10(s.mean[k]) : (s.low || s.mean)[k]);
          b[3] = Math.max(b[3], this.bars ? Math.log10(s.mean[k]) : (s.high || s.mean)[k]);
        }
      }
    if (!(b[0] <= b[1])) return [0, 1, 0, 1];
    if (b[0] === b[1]) b[1] += Math.abs(b[1]) || 1;
    if (this.bars) b[2] = Math.min(-0.3, b[2] - 0.3);
    else if (b[2] > 0 && b[2] < 0.3 * b[3]) b[2] = 0;
    if (!(b[2] < b[3])) [b[2], b[3]] = [b[2] - (Math.abs(b[2]) || 1) * 0.1, b[3] + (Math.abs(b[3]) || 1) * 0.1];
    return b;
  }

  draw() {
    const ratio = devicePixelRatio || 1, w = this.canvas.clientWidth, h = this.canvas.clientHeight;
    if (!w) return;
    this.canvas.width = Math.round(w * ratio);
    this.canvas.height = Math.round(h * ratio);
    const c = this.canvas.getContext('2d'), [x0, x1, y0, y1] = this.bounds();
    c.scale(ratio, ratio);
    c.font = '12px system-ui, sans-serif';
    const yTicks = ticks(y0, y1, 5), label = v => this.bars ? (Number.isInteger(v) ? '1e' + v : '') : text(+v.toPrecision(10));
    this.left = Math.max(...yTicks.map(v => c.measureText(label(v)).width), 20) + 8;
    this.width = w - this.left - 10;
    this.range = [x0, x1];
    const top = 8, height = h - top - 22;
    const px = x => this.left + (x - x0) / (x1 - x0) * this.width, py = y => top + height - (y - y0) / (y1 - y0) * height;
    c.fillStyle = css('--dim');
    c.strokeStyle = css('--line');
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const v of yTicks) {
      c.beginPath();
      c.moveTo(this.left, py(v));
      c.lineTo(w - 10, py(v));
      c.stroke();
      c.fillText(label(v), this.left - 5, py(v));
    }
    c.textAlign = 'center';
    c.textBaseline = 'top';
    const xName = this.xName || data.time_unit, room = w - 14 - c.measureText(xName).width;
    for (const v of ticks(x0, x1, Math.max(2, w / 90)))
      if (px(v) + c.measureText(label(v)).width / 2 < room) c.fillText(label(v), px(v), top + height + 6);
    c.textAlign = 'right';
    c.fillText(xName, w - 6, top + height + 6);
    this.series.forEach((s, k) => s.shown && (this.bars ? this.drawBars : this.drawLine).call(this, c, s, COLOURS[k % COLOURS.length], px, py, y0));
    const time = cursor ?? (view.times.length && state.frame >= 0 ? view.times[state.frame] : null);
    if (!this.bars && time !== null) {
      c.strokeStyle = css('--dim');
      c.setLineDash([4, 4]);
      c.beginPath();
      c.moveTo(px(time), top);
      c.lineTo(px(time), top + height);
      c.stroke();
      c.setLineDash([]);
    }
    this.series.forEach((s, k) => { this.values[k].textContent = this.bars ? '' : text(s.mean[nearest(s.x, time)]); });
  }

  drawLine(c, s, colour, px, py) {
    const known = [...s.x.keys()].filter(k => Number.isFinite(s.mean[k]));
    if (s.low && known.length) {
      c.fillStyle = colour + '33';
      c.beginPath();
      for (const k of known) c.lineTo(px(s.x[k]), py(s.high[k]));
      for (const k of known.reverse()) c.lineTo(px(s.x[k]), py(s.low[k]));
      c.fill();
      known.reverse();
    }
    c.strokeStyle = colour;
    c.lineWidth = 1.5;
    c.lineJoin = 'round';
    c.beginPath();
    for (const k of known) c.lineTo(px(s.x[k]), py(s.mean[k]));
    c.stroke();
    c.lineWidth = 1;
  }

  drawBars(c, s, colour, px, py, y0) {
    c.fillStyle = colour + 'bb';
    for (let k = 0; k < s.x.length; k++) {
      if (!(s.mean[k] > 0)) continue;
      const from = px(Math.log10(s.x[k])), to = px(Math.log10(s.x[k]) + 0.1), y = py(Math.log10(s.mean[k]));
      c.fillRect(from, y, Math.max(1, to - from - 1), py(y0) - y);
    }
  }
}

// The place in an ascending list that is closest to a value; the last where there is none.
function nearest(list, value) {
  if (value === null) return list.length - 1;
  let low = 0, high = list.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low > 0 && value - list[low - 1] < list[low] - value ? low - 1 : low;
}

async function showPlots() {
  const axes = await Promise.all(data.axes.map(packed => unpacked(packed, Float64Array)));
  for (const plot of data.plots) {
    const series = [];
    for (const s of plot.series) {
      const mean = await unpacked(s.mean, Float32Array);
      series.push({name: s.name, x: axes[s.axis], mean, low: s.low && await unpacked(s.low, Float32Array), high: s.high && await unpacked(s.high, Float32Array)});
    }
    new Chart(at('plots'), plot.title, plot.unit, series);
  }
  if (data.spectra.length) {
    const series = data.spectra.map(s => ({name: s.name, x: s.rows.map(r => r[0]), mean: s.rows.map(r => r[2])}));
    new Chart(at('plots'), 'Impacts by their energy', 'number in a bin', series, {bars: true, xName: data.energy_unit || 'energy'});
  }
}

// ---- the view

const view = {times: data.view.times, draw() {}};

const MESH_VERTEX = `#version 300 es
in vec3 place;
in float amount;
uniform mat3 turned;
uniform vec3 shifted;
uniform mat4 camera;
out vec3 where;
out float value;
void main() {
  where = turned * place + shifted;
  value = amount;
  gl_Position = camera * vec4(where, 1.0);
}`;

const RAMP = `
uniform vec3 ramp[9];
uniform float top;
uniform bool logarithmic;
// Three decades below the top with a logarithm, and all from 0 without.
vec3 colour_of(float v) {
  float t = logarithmic ? (v > 0.0 ? 1.0 + log(v / top) / log(1000.0) : 0.0) : v / top;
  t = clamp(t, 0.0, 1.0) * 8.0;
  int k = int(min(t, 7.0));
  return mix(ramp[k], ramp[k + 1], t - float(k));
}`;

const MESH_FRAGMENT = `#version 300 es
precision highp float;
in vec3 where;
in float value;
uniform vec3 back;
uniform float cut;
uniform bool plain;
out vec4 result;
${RAMP}
void main() {
  if (dot(where, back) > cut) discard;
  vec3 normal = normalize(cross(dFdx(where), dFdy(where)));
  float light = 0.55 + 0.45 * abs(dot(normal, back));
  result = vec4((plain ? vec3(0.72, 0.74, 0.77) : colour_of(value)) * light, 1.0);
}`;

const GRAIN_VERTEX = `#version 300 es
in vec3 place;
in float radius;
in float amount;
uniform mat4 camera;
uniform vec3 low, size, back;
uniform float largest, pixels, cut;
out float value;
out float depth;
out float reach;
void main() {
  vec3 where = low + size * place;
  reach = largest * radius;
  value = amount;
  gl_Position = camera * vec4(where, 1.0);
  depth = gl_Position.z;
  gl_PointSize = max(2.0 * reach * pixels, 1.5);
  if (dot(where, back) > cut) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const GRAIN_FRAGMENT = `#version 300 es
precision highp float;
in float value;
in float depth;
in float reach;
uniform float deep;
uniform int way;
uniform vec3 kinds[10];
out vec4 result;
${RAMP}
void main() {
  vec2 c = 2.0 * gl_PointCoord - 1.0;
  float q = dot(c, c);
  if (q > 1.0) discard;
  float z = sqrt(1.0 - q);
  gl_FragDepth = 0.5 + 0.5 * (depth - z * reach * deep);
  float light = 0.4 + 0.6 * max(0.0, dot(vec3(c.x, -c.y, z), normalize(vec3(-0.3, 0.5, 0.8))));
  vec3 colour = way == 0 ? vec3(0.76, 0.62, 0.46) : way == 1 ? colour_of(value) : kinds[(int(value) + 9) % 10];
  result = vec4(colour * light, 1.0);
}`;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  const places = {};
  return {made, at: name => places[name] ??= gl.getUniformLocation(made, name), attribute: name => gl.getAttribLocation(made, name)};
}

// Sixteen bits of a logarithm, as report.py packs them: 0 is 0, all else at most 1e9 below the largest.
const amountOf = (code, largest) => code === 0 ? 0 : largest * Math.exp((code - 65535) / 65534 * Math.log(1e9));

async function readMesh(gl, m) {
  const low = m.low, size = m.size, codes = await unpacked(m.points, Uint16Array);
  const triangles = await unpacked(m.triangles, m.wide ? Uint32Array : Uint16Array), fields = {};
  for (const [name, f] of Object.entries(m.fields)) fields[name] = {...f, codes: await unpacked(f.codes, Uint16Array)};
  const placesOf = c => {
    const flat = new Float32Array(3 * triangles.length);
    for (let i = 0; i < triangles.length; i++)
      for (let k = 0; k < 3; k++) flat[3 * i + k] = low[k] + size[k] * c[3 * triangles[i] + k] / 65535;
    return flat;
  };
  const own = [];
  for (const f of m.frames) own.push(f.points ? await unpacked(f.points, Uint16Array) : null);
  const mesh = {m, n: triangles.length / 3, fields, own, placesOf, places: gl.createBuffer(), amounts: gl.createBuffer(), values: new Float32Array(triangles.length)};
  gl.bindBuffer(gl.ARRAY_BUFFER, mesh.places);
  gl.bufferData(gl.ARRAY_BUFFER, placesOf(codes), gl.DYNAMIC_DRAW);
  return mesh;
}

function key(words, top, unit, ramp) {
  const line = made('p', state.log ? text(top / 1000, 2) : '0'), bar = document.createElement('i');
  bar.style.background = `linear-gradient(90deg, ${ramp.map(c => `rgb(${c})`).join(', ')})`;
  line.append(bar, `${text(top, 3)} ${unit}: ${words}`);
  at('keys').append(line);
}

function words(name) {
  return name.replaceAll('_', ' ');
}

async function showView() {
  const v = data.view, canvas = at('view'), gl = v.times.length && canvas.getContext('webgl2', {antialias: true, preserveDrawingBuffer: true});
  at('thinned').textContent = v.thinned;
  if (!gl) {
    at('scene').replaceWith(made('p', v.times.length ? 'This browser has no WebGL 2, by which meshes and grains are drawn.' : v.empty, {className: 'dim'}));
    return;
  }
  const meshes = [], grains = [];
  for (const m of v.meshes) meshes.push(await readMesh(gl, m));
  if (v.grains) for (const f of v.grains.frames) grains.push({n: f.n, codes: await unpacked(f.codes, Uint16Array)});

  const names = [...new Set(v.meshes.flatMap(m => Object.keys(m.fields)))];
  for (const name of ['', ...names, '-']) at('field').append(new Option(name === '' ? 'plain' : name === '-' ? 'hidden' : words(name), name));
  if (state.field && state.field !== '-' && !names.includes(state.field)) state.field = '';
  if (!('touched' in state)) state.field = names.includes('normal_stress') ? 'normal_stress' : names[0] || '';
  const ways = v.grains ? [...v.grains.ways, 'plain', 'hidden'] : ['none'];
  for (const way of ways) at('colour').append(new Option(way, way));
  if (!ways.includes(state.colour)) state.colour = ways[0];
  if (state.latest || state.frame < 0 || state.frame >= v.times.length) state.frame = v.times.length - 1;
  at('time').max = v.times.length - 1;
  at('play').hidden = at('time').hidden = v.times.length < 2;

  const ofMesh = program(gl, MESH_VERTEX, MESH_FRAGMENT), ofGrain = program(gl, GRAIN_VERTEX, GRAIN_FRAGMENT), buffer = gl.createBuffer();
  const centre = v.low.map((a, k) => (a + v.high[k]) / 2), extent = Math.hypot(...v.low.map((a, k) => v.high[k] - a)) || 1;
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2], rampOf = colours => colours.flat().map(c => c / 255);
  gl.enable(gl.DEPTH_TEST);

  const lastOf = () => {
    const {turn, tilt} = state, back = [Math.cos(tilt) * Math.cos(turn), Math.cos(tilt) * Math.sin(turn), Math.sin(tilt)];
    const right = [-Math.sin(turn), Math.cos(turn), 0];
    return {back, right, up: [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2], back[0] * right[1] - back[1] * right[0]]};
  };

  const drawMesh = (mesh, camera, back, cut) => {
    const frame = mesh.m.at[state.frame], f = mesh.m.frames[frame], pose = f.pose || [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0], field = mesh.fields[state.field];
    gl.uniformMatrix3fv(ofMesh.at('turned'), true, pose.slice(0, 9));
    gl.uniform3fv(ofMesh.at('shifted'), pose.slice(9));
    gl.uniform1i(ofMesh.at('plain'), field ? 0 : 1);
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.places);
    if (mesh.own[frame] && mesh.drawn !== frame) gl.bufferData(gl.ARRAY_BUFFER, mesh.placesOf(mesh.own[frame]), gl.DYNAMIC_DRAW);
    mesh.drawn = frame;
    gl.enableVertexAttribArray(ofMesh.attribute('place'));
    gl.vertexAttribPointer(ofMesh.attribute('place'), 3, gl.FLOAT, false, 0, 0);
    if (field) {
      gl.uniform1f(ofMesh.at('top'), field.top);
      for (let i = 0; i < mesh.n; i++) mesh.values.fill(amountOf(field.codes[frame * mesh.n + i], field.largest), 3 * i, 3 * i + 3);
      key(`${words(state.field)} of ${mesh.m.name}, up to ${text(field.largest, 3)}`, field.top, field.unit, VIRIDIS);
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.amounts);
    gl.bufferData(gl.ARRAY_BUFFER, mesh.values, gl.DYNAMIC_DRAW);
    gl.enableVertexAttribArray(ofMesh.attribute('amount'));
    gl.vertexAttribPointer(ofMesh.attribute('amount'), 1, gl.FLOAT, false, 0, 0);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * mesh.n);
  };

  const drawGrains = (camera, back, cut, pixels) => {
    const g = v.grains, {n, codes} = grains[g.at[state.frame]], rows = new Float32Array(5 * n), way = state.colour;
    for (let i = 0; i < n; i++) {
      for (let k = 0; k < 3; k++) rows[5 * i + k] = codes[k * n + i] / 65535;
      rows[5 * i + 3] = codes[3 * n + i] / 65535;
      rows[5 * i + 4] = way === 'speed' ? amountOf(codes[4 * n + i], g.largest_speed) : way === 'size' ? 2 * g.largest * codes[3 * n + i] / 65535 : codes[5 * n + i];
    }
    gl.useProgram(ofGrain.made);
    gl.uniformMatrix4fv(ofGrain.at('camera'), false, camera);
    for (const [name, value] of [['low', g.low], ['size', g.size], ['back', back]]) gl.uniform3fv(ofGrain.at(name), value);
    for (const [name, value] of [['largest', g.largest], ['pixels', pixels], ['cut', cut], ['deep', 1 / extent], ['top', (way === 'size' ? 2 * g.largest : g.top_speed) || 1]])
      gl.uniform1f(ofGrain.at(name), value);
    gl.uniform1i(ofGrain.at('logarithmic'), state.log && way === 'speed' ? 1 : 0);
    gl.uniform1i(ofGrain.at('way'), way === 'plain' ? 0 : way === 'kind' ? 2 : 1);
    gl.uniform3fv(ofGrain.at('ramp'), rampOf(HEAT));
    gl.uniform3fv(ofGrain.at('kinds'), rampOf(COLOURS.map(c => c.match(/\w\w/g).map(h => parseInt(h, 16)))));
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, rows, gl.DYNAMIC_DRAW);
    for (const [name, count, first] of [['place', 3, 0], ['radius', 1, 3], ['amount', 1, 4]]) {
      gl.enableVertexAttribArray(ofGrain.attribute(name));
      gl.vertexAttribPointer(ofGrain.attribute(name), count, gl.FLOAT, false, 20, 4 * first);
    }
    gl.drawArrays(gl.POINTS, 0, n);
    if (way === 'speed') key(`speed of grains, up to ${text(g.largest_speed, 3)}`, g.top_speed, g.speed_unit, HEAT);
    if (way === 'size') {
      const log = state.log;
      state.log = false;
      key('diameter of grains', 2 * g.largest, g.size_unit, HEAT);
      state.log = log;
    }
  };

  view.draw = () => {
    const ratio = Math.min(devicePixelRatio || 1, 2), w = canvas.width = Math.round(canvas.clientWidth * ratio), h = canvas.height = Math.round(canvas.clientHeight * ratio);
    const {back, right, up} = lastOf(), scale = 1.9 * state.zoom / extent * Math.min(1, w / h), across = scale * h / w, deep = 1 / extent, camera = [];
    for (let k = 0; k < 3; k++) camera.push(right[k] * across, up[k] * scale, -back[k] * deep, 0);
    camera.push(-dot(right, centre) * across + state.shift[0], -dot(up, centre) * scale + state.shift[1], dot(back, centre) * deep, 1);
    const cut = dot(back, centre) + extent * 0.5 * (1 - state.cut / 50), card = css('--card').match(/\w\w/g).map(c => parseInt(c, 16) / 255);
    gl.viewport(0, 0, w, h);
    gl.clearColor(...card, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    at('keys').replaceChildren();
    gl.useProgram(ofMesh.made);
    gl.uniformMatrix4fv(ofMesh.at('camera'), false, camera);
    gl.uniform3fv(ofMesh.at('back'), back);
    gl.uniform1f(ofMesh.at('cut'), cut);
    gl.uniform1i(ofMesh.at('logarithmic'), state.log ? 1 : 0);
    gl.uniform3fv(ofMesh.at('ramp'), rampOf(VIRIDIS));
    if (state.field !== '-') for (const mesh of meshes) drawMesh(mesh, camera, back, cut);
    if (v.grains && state.colour !== 'hidden') drawGrains(camera, back, cut, scale * h / 2);
    at('now').textContent = `${text(v.times[state.frame])} ${data.time_unit}`;
    for (const [id, value] of [['time', state.frame], ['field', state.field], ['colour', state.colour], ['cut', state.cut]]) at(id).value = value;
    at('log').checked = state.log;
    for (const chart of charts) chart.draw();
  };
  steer(canvas);
  view.draw();
}

// ---- what the user does with the view

function set(changes) {
  Object.assign(state, changes, {touched: true});
  state.latest = state.frame === view.times.length - 1;
  save();
  view.draw();
}

function steer(canvas) {
  at('time').oninput = e => set({frame: +e.target.value});
  at('field').onchange = e => set({field: e.target.value});
  at('colour').onchange = e => set({colour: e.target.value});
  at('log').onchange = e => set({log: e.target.checked});
  at('cut').oninput = e => set({cut: +e.target.value});
  at('home').onclick = () => set({...HOME});
  let playing = 0;
  at('play').onclick = () => {
    clearInterval(playing);
    playing = playing ? 0 : setInterval(() => set({frame: (state.frame + 1) % view.times.length}), 100);
    at('play').textContent = playing ? '❚❚' : '▶';
    at('play').setAttribute('aria-label', playing ? 'Stop' : 'Play');
  };
  const fingers = new Map();
  let apart = 0;
  canvas.style.touchAction = 'none';
  canvas.onpointerdown = e => {
    canvas.setPointerCapture(e.pointerId);
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
    apart = 0;
  };
  canvas.onpointerup = canvas.onpointercancel = e => {
    fingers.delete(e.pointerId);
    apart = 0;
  };
  canvas.onpointermove = e => {
    if (!fingers.has(e.pointerId)) return;
    const [x, y] = fingers.get(e.pointerId), dx = e.clientX - x, dy = e.clientY - y;
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
    const moved = k => [state.shift[0] + k * dx / canvas.clientWidth, state.shift[1] - k * dy / canvas.clientHeight];
    if (fingers.size === 2) {
      const [a, b] = [...fingers.values()], now = Math.hypot(a[0] - b[0], a[1] - b[1]), zoom = apart ? state.zoom * now / apart : state.zoom;
      apart = now;
      set({zoom, shift: moved(1)});
    } else if (e.shiftKey || e.buttons === 4) {
      set({shift: moved(2)});
    } else {
      set({turn: state.turn - 0.01 * dx, tilt: Math.max(-1.57, Math.min(1.57, state.tilt + 0.01 * dy))});
    }
  };
  canvas.addEventListener('wheel', e => {
    e.preventDefault();
    set({zoom: state.zoom * Math.exp(-0.001 * e.deltaY)});
  }, {passive: false});
}

function redraw() {
  view.draw();
  for (const chart of charts) chart.draw();
}

async function show() {
  showTexts();
  showNumbers();
  await showPlots();
  await showView();
  addEventListener('resize', redraw);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
}

show().then(() => {
  document.body.dataset.ready = 'yes';
}, error => {
  document.body.dataset.ready = 'no';
  at('thinned').textContent = `The page could not be drawn in full: ${error.message}`;
  console.error(error);
});
if (data.follow) setTimeout(() => {
  save();
  location.reload();
}, 1000 * data.follow);
