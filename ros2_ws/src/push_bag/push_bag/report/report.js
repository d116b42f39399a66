// The time cursor of the report, shared by the animation and the plots.
// Figures are drawn when they are scrolled to (figures.js); before, they are not updated.
// `ANIMATION` is written by animation.py: lengths in mm, times in s, one time axis for all runs.
const view = document.getElementById('animation');
const errors = document.getElementById('time');
const lap = document.getElementById('lap');
const slider = document.getElementById('cursor');
const label = document.getElementById('cursor-time');
const playButton = document.getElementById('play');
const pace = document.getElementById('pace');

let cursor = 0;
let playing = false;
let lastFrame = 0;
let lastMark = 0;
const MARK_PERIOD = 250; // [ms] between updates of the cursor in the plots while playing

function frameAt(run, time) {
  let low = 0;
  let high = run.time.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (run.time[middle] <= time) low = middle; else high = middle - 1;
  }
  return low;
}

function placed(run, frame, points) {
  const [x, y, theta] = [run.x[frame], run.y[frame], run.theta[frame]];
  const [cos, sin] = [Math.cos(theta), Math.sin(theta)];
  return [points.map(([u, v]) => x + cos * u - sin * v),
          points.map(([u, v]) => y + sin * u + cos * v)];
}

function outline(run, frame) {
  const half = run.side / 2;
  const corners = [[-half, -half], [half, -half], [half, half], [-half, half], [-half, -half]];
  return placed(run, frame, corners);
}

function tip(run, frame) {
  const circle = Array.from({ length: 25 }, (_, k) => (2 * Math.PI * k) / 24);
  return [circle.map((a) => run.tip_x[frame] + run.tip_radius * Math.cos(a)),
          circle.map((a) => run.tip_y[frame] + run.tip_radius * Math.sin(a))];
}

function trail(run, frame) {
  const start = Math.max(0, frame - 400);
  return [run.x.slice(start, frame + 1), run.y.slice(start, frame + 1)];
}

function horizon(run, frame) {
  const width = run.horizon_points;
  return [run.horizon_x.slice(frame * width, (frame + 1) * width),
          run.horizon_y.slice(frame * width, (frame + 1) * width)];
}

// the moving traces of each run, in their order
const MOVING = [trail, outline, horizon, tip];

function draw() {
  if (!view.data) return;
  const x = [];
  const y = [];
  for (const run of ANIMATION.runs) {
    const frame = frameAt(run, cursor);
    for (const part of MOVING) {
      const line = run.time.length ? part(run, frame) : [[], []];
      x.push(line[0]);
      y.push(line[1]);
    }
  }
  Plotly.restyle(view, { x, y }, x.map((_, k) => ANIMATION.first_trace + k));
}

// takes several times as long as a frame of the animation
function markTime() {
  if (!errors.data) return;
  Plotly.relayout(errors, { 'shapes[0].x0': cursor, 'shapes[0].x1': cursor });
  lastMark = performance.now();
}

function moveTo(time) {
  cursor = Math.min(Math.max(time, 0), ANIMATION.duration);
  slider.value = cursor;
  label.textContent = `${cursor.toFixed(2)} s`;
  draw();
  if (!playing || performance.now() - lastMark > MARK_PERIOD) markTime();
}

function advance(now) {
  if (!playing) return;
  moveTo(cursor + (Number(pace.value) * (now - lastFrame)) / 1000);
  lastFrame = now;
  if (cursor >= ANIMATION.duration) play(false);
  else requestAnimationFrame(advance);
}

function play(on) {
  playing = on;
  playButton.textContent = on ? 'Pause' : 'Play';
  if (!on) {
    markTime();
    return;
  }
  if (cursor >= ANIMATION.duration) cursor = 0;
  lastFrame = performance.now();
  requestAnimationFrame(advance);
}

slider.max = ANIMATION.duration;
slider.addEventListener('input', () => moveTo(Number(slider.value)));
playButton.addEventListener('click', () => play(!playing));
view.addEventListener('drawn', draw);
errors.addEventListener('drawn', () => {
  markTime();
  errors.on('plotly_click', (event) => moveTo(event.points[0].x));
});
lap.addEventListener('drawn', () => {
  lap.on('plotly_click', (event) => {
    const data = event.points[0].customdata;
    if (data) moveTo(data[0]);
  });
});
moveTo(0);
