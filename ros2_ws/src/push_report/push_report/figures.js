// Draws each figure of the report when it comes near the window, and tells its element so.
'use strict';

const CONFIG = { displaylogo: false, responsive: true };
const NEAR = '50% 0px'; // half a window ahead

const places = document.querySelectorAll('.figure');

const NARROW = 600; // [px] of the window; below it a figure is laid out for a phone

// A colour bar goes below the plot, margins and letters get small, a map no higher than wide.
function narrowed({ data, layout }, width) {
  const below = { orientation: 'h', x: 0.5, xanchor: 'center', y: -0.2, yanchor: 'top', len: 1 };
  for (const { marker } of data) {
    if (!marker || !marker.colorbar) continue;
    const title = { ...marker.colorbar.title, side: 'bottom' };
    Object.assign(marker.colorbar, below, { thickness: 12, title });
    layout.margin.b = 110;
  }
  layout.font.size = 11;
  Object.assign(layout.margin, { l: 48, r: 10 });
  for (const [name, axis] of Object.entries(layout)) {
    if (name.startsWith('yaxis')) axis.automargin = true; // beside wide numbers a wider margin
  }
  const isMap = Object.values(layout).some((axis) => axis && axis.scaleanchor);
  if (isMap) layout.height = Math.min(layout.height, width + 190);
}

function drawFigure(place) {
  if (place.data) return;
  const { data, layout } = JSON.parse(document.getElementById(`${place.id}-figure`).textContent);
  if (window.innerWidth < NARROW) {
    narrowed({ data, layout }, place.clientWidth);
    place.style.height = `${layout.height}px`;
  }
  Plotly.newPlot(place, data, layout, CONFIG);
  place.dispatchEvent(new Event('drawn'));
}

const nearby = new IntersectionObserver((entries) => {
  for (const { target } of entries.filter((entry) => entry.isIntersecting)) {
    nearby.unobserve(target);
    // each in a turn of its own: the upper one is seen before the next is drawn
    setTimeout(drawFigure, 0, target);
  }
}, { rootMargin: NEAR });

places.forEach((place) => nearby.observe(place));
window.addEventListener('beforeprint', () => places.forEach(drawFigure));
