// Draws each figure of the report when it comes near the window, and tells its element so.
'use strict';

const CONFIG = { displaylogo: false, responsive: true };
const NEAR = '50% 0px'; // half a window ahead

const places = document.querySelectorAll('.figure');

function drawFigure(place) {
  if (place.data) return;
  const { data, layout } = JSON.parse(document.getElementById(`${place.id}-figure`).textContent);
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
