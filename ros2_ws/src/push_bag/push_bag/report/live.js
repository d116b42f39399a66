// The page of a running cell: draws each state that the server sends.
// States are written by cell_view.py: lengths in mm, velocities in mm/s, times in s.
const byId = (id) => document.getElementById(id);
const SPAN = 20; // [s] that the figures show
const MAP_PERIOD = 60; // [ms] between updates of the map
const LINE_PERIOD = 400; // [ms] between updates of the figures over time
const HOLE = 0.5; // [s] without a state, over which no line is drawn
const MARGIN = 80; // [mm] round the reference
const BAD = ['stopped', 'stopping', 'fault', 'holding', 'no controller'];

let plan = null;
let planNumber = -1;
let newest = null;
let mapDrawn = 0;
let linesDrawn = 0;
const history = []; // of states, the last SPAN seconds

function outline([x, y, theta], side) {
  const half = side / 2;
  const [cos, sin] = [Math.cos(theta), Math.sin(theta)];
  const corners = [[-half, -half], [half, -half], [half, half], [-half, half], [-half, -half]];
  return [corners.map(([u, v]) => x + cos * u - sin * v),
          corners.map(([u, v]) => y + sin * u + cos * v)];
}

function circle([x, y], radius) {
  const angles = Array.from({ length: 25 }, (_, k) => (2 * Math.PI * k) / 24);
  return [angles.map((a) => x + radius * Math.cos(a)), angles.map((a) => y + radius * Math.sin(a))];
}

const part = (name, index, factor = 1) => (state) => {
  const value = state[name] ? state[name][index] : null;
  return value === null || value === undefined ? null : factor * value;
};

function drawMap() {
  const view = byId('map');
  if (!view.data || !newest) return;
  const nothing = [[], []];
  const lines = [
    plan ? [plan.x, plan.y] : nothing,
    [history.map(part('object', 0)), history.map(part('object', 1))],
    newest.object ? outline(newest.object, plan ? plan.side : 90) : nothing,
    newest.horizon && newest.error !== null ? newest.horizon : nothing,
    newest.tip ? circle(newest.tip, plan ? plan.tip_radius : 5) : nothing,
  ];
  Plotly.restyle(view, { x: lines.map((line) => line[0]), y: lines.map((line) => line[1]) });
}

function span(values) {
  return [Math.min(...values) - MARGIN, Math.max(...values) + MARGIN];
}

function drawLines(id, series) {
  const figure = byId(id);
  if (!figure.data) return;
  const time = history.map((state) => state.time - newest.time);
  Plotly.restyle(figure, { x: series.map(() => time), y: series.map((of) => history.map(of)) });
}

function drawAllLines() {
  drawLines('errors', ['error', 'p_y', 'gap'].map((name) => (state) => state[name] ?? null));
  drawLines('velocities', [part('command', 0), part('tip_velocity', 0),
                           part('command', 1), part('tip_velocity', 1)]);
  drawLines('estimates', [part('disturbance', 0, 1000), part('disturbance', 1, 1000),
                          part('disturbance', 2, 180 / Math.PI)]);
  linesDrawn = performance.now();
}

function number(value, digits) {
  return value === null || value === undefined ? '–' : value.toFixed(digits);
}

function write() {
  const mode = newest.silent ? 'no poses come' : newest.mode || 'no controller';
  byId('mode').textContent = mode;
  byId('mode').className = `verdict ${newest.silent || BAD.includes(mode) ? 'no' : 'yes'}`;
  byId('reason').textContent = newest.reason || '';
  byId('error').textContent = number(newest.error, 2);
  byId('p_y').textContent = number(newest.p_y, 1);
  const [x, y] = newest.tip_velocity || [null, null];
  byId('speed').textContent = number(x === null ? null : Math.hypot(x, y), 0);
  byId('reference_time').textContent = number(newest.reference_time, 2);
  byId('solve_ms').textContent = number(newest.solve_ms, 2);
}

async function readPlan() {
  planNumber = newest.plan;
  plan = await (await fetch('plan.json')).json();
  if (!plan.x) { plan = null; return; }
  byId('title').textContent = plan.title;
  fitMap();
}

function fitMap() {
  const view = byId('map');
  if (view.data && plan) {
    Plotly.relayout(view, { 'xaxis.range': span(plan.x), 'yaxis.range': span(plan.y) });
  }
}

function take(state) {
  // a replay or a new cell begins anew
  if (newest && state.time < newest.time) history.length = 0;
  // what was seen last stays in view
  newest = state.silent && newest ? { ...newest, drawn: false, ...state, tip_velocity: null } : state;
  const last = history.at(-1);
  if (last && state.time - last.time > HOLE) history.push({ time: state.time });
  history.push(state);
  while (history[0].time < state.time - SPAN) history.shift();
  if (state.plan !== planNumber) readPlan();
}

function draw() {
  const now = performance.now();
  if (newest && newest.drawn !== true && now - mapDrawn > MAP_PERIOD) {
    newest.drawn = true;
    mapDrawn = now;
    write();
    drawMap();
    if (now - linesDrawn > LINE_PERIOD) drawAllLines();
  }
  requestAnimationFrame(draw);
}

async function ask(name) {
  byId('answer').textContent = '…';
  const answer = await fetch(name, { method: 'POST', headers: { 'X-Push-Control': '1' } });
  byId('answer').textContent = await answer.text();
}

document.querySelectorAll('#buttons button').forEach((button) => {
  button.addEventListener('click', () => ask(button.id));
});
byId('map').addEventListener('drawn', fitMap);
const events = new EventSource('events');
events.addEventListener('message', (event) => take(JSON.parse(event.data)));
events.addEventListener('error', () => {
  byId('mode').textContent = 'the live view has ended';
  byId('mode').className = 'verdict no';
});
requestAnimationFrame(draw);
