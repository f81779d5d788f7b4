// What is drawn on the chart: grid, area, fences, structures, stand-offs, legs, waypoints, places, home and the end. All sizes are pixels, so marks keep theirs at any zoom.

import { cut, metres, number } from "./format.js";
import { colour } from "./task.js";
import { html } from "./vendor.js";
import { lines, project, round, unproject } from "./view.js";

const path = (pixels) => pixels.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" ");

export function Grid({ view, size }) {
  const step = round(view.scale, 64);
  const [left, top] = unproject(view, size, [0, 0]);
  const [right, bottom] = unproject(view, size, [size.width, size.height]);
  const upright = lines(left, right, step).map((x) => [x, project(view, size, [x, 0])[0]]);
  const level = lines(bottom, top, step).map((y) => [y, project(view, size, [0, y])[1]]);
  const label = (value) => (Math.abs(value) >= 10000 ? `${number(value / 1000)} km` : number(value));
  return html`<g class="grid" aria-hidden="true">
    ${upright.map(([x, px]) => html`<line key=${`x${x}`} class=${Math.abs(x) < step / 2 ? "axis" : ""} x1=${px} x2=${px} y1="0" y2=${size.height} />`)}
    ${level.map(([y, py]) => html`<line key=${`y${y}`} class=${Math.abs(y) < step / 2 ? "axis" : ""} x1="0" x2=${size.width} y1=${py} y2=${py} />`)}
    ${upright.filter(([, px]) => px > 40 && px < size.width - 24).map(([x, px]) => html`<text key=${`xl${x}`} x=${px} y="14" text-anchor="middle">${label(x)}</text>`)}
    ${level.filter(([, py]) => py > 26 && py < size.height - 44).map(([y, py]) => html`<text key=${`yl${y}`} x="6" y=${py + 4}>${label(y)}</text>`)}
  </g>`;
}

export function Scale({ view, size }) {
  const length = round(view.scale, 60);
  const width = length * view.scale;
  const [x, y] = [14, size.height - 16];
  return html`<g class="scale" aria-hidden="true"><rect x="6" y=${size.height - 40} width=${width + 16} height="34" /><path d=${`M${x} ${y - 6}v6h${width}v-6`} /><text x=${x + width / 2} y=${y - 8} text-anchor="middle">${metres(length)}</text></g>
    <g class="north" aria-hidden="true" transform=${`translate(${size.width - 26} 40)`}><path d="M0 -22L7 6L0 1L-7 6Z" /><text y="20" text-anchor="middle">N</text></g>`;
}

/** The vehicle's area, fences, structures with the distance that is kept from them, boundaries of steps and stand-offs of tasks. */
export function Areas({ store, at, view }) {
  const { document, track, brief } = store.plan;
  const numbers = Object.fromEntries(document.tasks.map((task, index) => [task.id, index]));
  const state = (task) => (store.selected ? (store.selected.task === task ? "chosen" : "faint") : "");
  return html`<g class="areas">
    ${document.vehicle?.area && html`<polygon class="area" points=${path(document.vehicle.area.map(at))}><title>The area of the vehicle</title></polygon>`}
    ${brief.fences.map((fence, i) => html`<polygon key=${`f${i}`} class=${`fence ${fence.inside ? "inside" : "outside"}`} points=${path(fence.polygon.map(at))}><title>${fence.text}</title></polygon>`)}
    ${brief.structures.map(({ name, position, standoff }) => {
      const [x, y] = at(position);
      return html`<g key=${`s${position}`} class="structure"><circle cx=${x} cy=${y} r=${standoff * view.scale}><title>${name}: ${metres(standoff)} are kept from it</title></circle>
        <path d=${`M${x - 5} ${y - 5}h10v10h-10Z`} /></g>`;
    })}
    ${track.boundaries.map((boundary, i) => html`<polygon key=${`b${i}`} class=${`boundary ${colour(numbers[boundary.task])} ${state(boundary.task)}`} points=${path(boundary.polygon.map(at))}><title>Boundary of step ${numbers[boundary.task] + 1}.${boundary.step + 1}</title></polygon>`)}
    ${track.circles.map((circle, i) => {
      const [x, y] = at(circle.center);
      const r = circle.radius * view.scale;
      const said = `r ${metres(circle.radius)}${circle.arc ? `, ${number(circle.arc)}°` : ""}`;
      return html`<g key=${`c${i}`} class=${`circle ${colour(numbers[circle.task])} ${state(circle.task)}`} data-task=${circle.task}><circle cx=${x} cy=${y} r=${r}><title>Stand-off of task ${numbers[circle.task] + 1}: ${said}</title></circle>
        ${r > 24 && html`<text x=${x} y=${y + r + 14} text-anchor="middle">${said}</text>`}</g>`;
    })}
  </g>`;
}

/** Legs in the colour of their task, with the direction on those that are long enough to show it. */
export function Legs({ store, at }) {
  const { document, track } = store.plan;
  const numbers = Object.fromEntries(document.tasks.map((task, index) => [task.id, index]));
  const { selected } = store;
  return html`<g class="legs">${track.legs.map((leg, i) => {
    if (!leg.points.length) return null;
    const pixels = leg.points.map(at);
    const mine = selected && selected.task === leg.task && (selected.step === undefined || selected.step === leg.step);
    const title = html`<title>${numbers[leg.task] + 1}.${leg.step + 1} ${leg.skill}${leg.metres > 0 ? `, ${metres(leg.metres)}` : ""}</title>`;
    const named = `leg ${leg.kind} ${colour(numbers[leg.task])} ${mine ? "chosen" : selected ? "faint" : ""}`;
    if (pixels.length === 1) return html`<circle key=${i} class=${named} data-task=${leg.task} data-step=${leg.step} cx=${pixels[0][0]} cy=${pixels[0][1]} r=${leg.kind === "turn" ? 6 : 10}>${title}</circle>`;
    return html`<g key=${i} class=${named} data-task=${leg.task} data-step=${leg.step}><polyline class="reach" points=${path(pixels)} /><polyline points=${path(pixels)}>${title}</polyline><${Arrow} pixels=${pixels} /></g>`;
  })}</g>`;
}

function Arrow({ pixels }) {
  const half = Math.floor((pixels.length - 1) / 2);
  const [[x1, y1], [x2, y2]] = [pixels[half], pixels[half + 1]];
  const whole = Math.hypot(pixels[pixels.length - 1][0] - pixels[0][0], pixels[pixels.length - 1][1] - pixels[0][1]);
  if (Math.hypot(x2 - x1, y2 - y1) < 30 && whole < 30) return null;
  return html`<path class="arrow" d="M-5 -5L5 0L-5 5" transform=${`translate(${(x1 + x2) / 2} ${(y1 + y2) / 2}) rotate(${(Math.atan2(y2 - y1, x2 - x1) * 180) / Math.PI})`} />`;
}

/** Numbers at the ends of legs; one that would lie on another is left out, those of the selected task come first. */
export function Waypoints({ store, at, size, taken }) {
  const { document, track } = store.plan;
  const numbers = Object.fromEntries(document.tasks.map((task, index) => [task.id, index]));
  const ends = track.legs.filter((leg) => leg.points.length > 1).map((leg) => ({ leg, pixel: at(leg.points[leg.points.length - 1]), text: `${numbers[leg.task] + 1}.${leg.step + 1}` }))
    .filter(({ pixel: [x, y] }) => x > -20 && y > -20 && x < size.width + 20 && y < size.height + 20);
  const first = ({ leg }) => (store.selected?.task === leg.task ? (store.selected.step === leg.step ? 0 : 1) : 2);
  const named = ends.filter(({ leg }) => !store.selected || store.selected.task === leg.task).sort((a, b) => first(a) - first(b)).filter(({ pixel: [x, y], text }) => taken.claim(x + 6, y - 18, text.length * 7 + 4, 16));
  const faint = (leg) => (store.selected && store.selected.task !== leg.task ? "faint" : "");
  return html`<g class="waypoints">
    ${ends.map(({ leg, pixel: [x, y] }, i) => html`<circle key=${i} class=${`${colour(numbers[leg.task])} ${faint(leg)}`} data-task=${leg.task} data-step=${leg.step} cx=${x} cy=${y} r="3.5" />`)}
    ${named.map(({ leg, pixel: [x, y], text }) => html`<text key=${text} class=${colour(numbers[leg.task])} x=${x + 8} y=${y - 6}>${text}</text>`)}
  </g>`;
}

/** Names of places and structures, home, and where the vehicle ends. */
export function Places({ store, at, taken, view, size }) {
  const anchor = (x) => (x < 90 ? "start" : x > size.width - 90 ? "end" : "middle");
  const { track, brief } = store.plan;
  const places = track.targets.filter((one) => one.position);
  const named = new Set(places.map((one) => String(one.position)));
  const { end } = track;
  const isHome = end && Math.hypot(end[0] - store.plan.vocabulary.home[0], end[1] - store.plan.vocabulary.home[1]) < 1;
  const home = at(store.plan.vocabulary.home);
  taken.claim(home[0] - 10, home[1] - 12, 20, 20);
  taken.claim(home[0] - 20, home[1] + 10, 40, 14);
  return html`<g class="places">
    <g class="home" transform=${`translate(${home[0]} ${home[1]})`}><path d="M-9 1L0 -9L9 1M-6 -2V8H6V-2" /><text y="22" text-anchor="middle">${isHome ? "home, end" : "home"}</text></g>
    ${places.map((one) => {
      const [x, y] = at(one.position);
      taken.claim(x - 40, y - 30, 80, 40);
      return html`<g key=${one.name} class="target" transform=${`translate(${x} ${y})`}><path d="M0 -9L9 0L0 9L-9 0Z" /><circle r="1.5" /><text y="-14" text-anchor=${anchor(x)}>${cut(one.name)}<title>${one.name}</title></text></g>`;
    })}
    ${brief.structures.filter((one) => !named.has(String(one.position))).map(({ name, position, standoff }) => {
      const [x, y] = at(position);
      taken.claim(x - 40, y - 26, 80, 36);
      return html`<text key=${`n${position}`} class="structure" x=${x} y=${y - 10 - (standoff * view.scale > 24 ? 0 : standoff * view.scale)} text-anchor=${anchor(x)}>${cut(name)}, ${metres(standoff)} off<title>${name}</title></text>`;
    })}
    ${end && !isHome && html`<g class="end" transform=${`translate(${at(end).join(" ")})`}><path d="M0 0V-20L14 -15L0 -10" /><text x="4" y="14">end</text></g>`}
  </g>`;
}

/** Rectangles of pixels that labels have taken already. */
export class Taken {
  constructor() {
    this.cells = new Map();
  }

  claim(x, y, width, height) {
    const cells = [];
    for (let column = Math.floor(x / 40); column <= Math.floor((x + width) / 40); column += 1) for (let row = Math.floor(y / 40); row <= Math.floor((y + height) / 40); row += 1) cells.push(`${column} ${row}`);
    const meets = (other) => other[0] < x + width && x < other[0] + other[2] && other[1] < y + height && y < other[1] + other[3];
    if (cells.some((cell) => (this.cells.get(cell) || []).some(meets))) return false;
    for (const cell of cells) this.cells.set(cell, [...(this.cells.get(cell) || []), [x, y, width, height]]);
    return true;
  }
}
