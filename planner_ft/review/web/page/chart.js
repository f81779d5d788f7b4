// The chart of the track in the local frame: x east, y north, metres. Wheel, pinch and keys move the view; a place is put here.

import { latitudeLongitude, metres, number, place, seconds } from "./format.js";
import { gestures } from "./gestures.js";
import { Areas, Grid, Legs, Places, Scale, Taken, Waypoints } from "./marks.js";
import { Vessel } from "./run.js";
import { Tray } from "./tray.js";
import { html, useEffect, useMemo, useRef, useState } from "./vendor.js";
import { fit, pan, project, round, snap, unproject, zoom } from "./view.js";

/** Everything that the first view must hold. */
function extent({ track, vocabulary, brief }) {
  const around = ({ center: [x, y], radius }) => [[x - radius, y - radius], [x + radius, y + radius]];
  return [vocabulary.home, ...track.legs.flatMap((leg) => leg.points), ...track.circles.flatMap(around), ...track.boundaries.flatMap((boundary) => boundary.polygon), ...track.targets.map((one) => one.position).filter(Boolean),
    ...brief.structures.flatMap(({ position, standoff }) => around({ center: position, radius: standoff })), ...brief.fences.flatMap((fence) => fence.polygon)];
}

function useSize(ref) {
  const [size, set] = useState({ width: 640, height: 480 });
  useEffect(() => {
    const measure = () => set({ width: Math.max(ref.current.clientWidth, 50), height: Math.max(ref.current.clientHeight, 50) });
    const observer = new ResizeObserver(measure);
    observer.observe(ref.current);
    measure();
    return () => observer.disconnect();
  }, []);
  return size;
}

export function Chart({ store }) {
  const { track, document: { origin } } = store.plan;
  const frame = useRef();
  const svg = useRef();
  const size = useSize(frame);
  const whole = useMemo(() => fit(extent(store.plan), size), [store.plan.track, size.width, size.height]);
  const [own, setView] = useState(null); // null: the whole track, also when it changes
  const view = own || whole;
  const [cursor, hover] = useState(null);
  const [aim, setAim] = useState(null); // where the place that is being put would go
  const { placing } = store;
  useEffect(() => {
    setAim(placing ? snap(view, [view.x, view.y]) : null);
    if (placing) svg.current.focus({ preventScroll: true });
    if (placing) frame.current.scrollIntoView({ block: "nearest" });
  }, [placing]);
  const put = (name, point) => {
    store.set({ placing: null });
    setAim(null);
    store.editOrTell({ kind: "locate", name, position: point }, `${name} placed at ${place(point)}`);
  };
  const now = useRef();
  now.current = { view, size, placing };
  const act = useRef({
    zoom: (pixel, factor) => setView(zoom(now.current.view, now.current.size, pixel, factor)),
    pan: (dx, dy) => setView(pan(now.current.view, dx, dy)),
    hover: (pixel) => hover(pixel && unproject(now.current.view, now.current.size, pixel)),
  }).current;
  act.tap = (pixel, element) => {
    if (placing) return put(placing, snap(view, unproject(view, size, pixel)));
    const mark = element.closest("[data-task]");
    return store.select(mark ? { task: mark.dataset.task, ...(mark.dataset.step !== undefined ? { step: Number(mark.dataset.step) } : {}), from: "chart" } : null);
  };
  useEffect(() => gestures(svg.current, act), []);
  const drop = useRef((name, x, y, done) => {
    const box = svg.current.getBoundingClientRect();
    const inside = x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
    const point = inside ? snap(now.current.view, unproject(now.current.view, now.current.size, [x - box.left, y - box.top])) : null;
    setAim(done ? null : point);
    if (done && point) put(name, point);
  }).current;
  const keys = (event) => {
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (arrow && placing && aim) {
      const step = round(view.scale, 4) * (event.shiftKey ? 10 : 1);
      setAim(aim.map((part, i) => Number((part + arrow[i] * step).toFixed(2))));
    } else if (arrow) setView(pan(view, -arrow[0] * 48, arrow[1] * 48));
    else if (event.key === "Enter" && placing && aim) put(placing, aim);
    else if (event.key === "Escape" && placing) store.set({ placing: null });
    else if (event.key === "Escape") store.select(null);
    else if (event.key === "+" || event.key === "=") setView(zoom(view, size, [size.width / 2, size.height / 2], 1.3));
    else if (event.key === "-") setView(zoom(view, size, [size.width / 2, size.height / 2], 1 / 1.3));
    else if (event.key === "0") setView(null);
    else return;
    event.preventDefault();
  };
  const at = (point) => project(view, size, point);
  const taken = new Taken();
  const middle = [size.width / 2, size.height / 2];
  return html`<section class="panel chart" aria-labelledby="chart-title">
    <header><h2 id="chart-title">Chart</h2><span class="soft">metres east (x) and north (y) of home${origin ? `; [0, 0] is ${latitudeLongitude([0, 0], origin)}` : "; where that is on earth is not known"}</span><span class="space"></span>
      <button aria-label="Farther" onClick=${() => setView(zoom(view, size, middle, 1 / 1.4))}>−</button>
      <button aria-label="Nearer" onClick=${() => setView(zoom(view, size, middle, 1.4))}>+</button>
      <button disabled=${!own} onClick=${() => setView(null)}>Everything</button></header>
    <${Tray} store=${store} drop=${drop} />
    <div class=${`frame ${placing ? "placing" : ""}`} ref=${frame}>
      <svg id="chart-view" ref=${svg} width=${size.width} height=${size.height} tabindex="0" role="application" aria-label=${told(store, placing, aim)} aria-describedby="chart-words" onKeyDown=${keys}>
        <${Grid} view=${view} size=${size} />
        <${Areas} store=${store} at=${at} view=${view} />
        <${Legs} store=${store} at=${at} />
        <${Places} store=${store} at=${at} taken=${taken} view=${view} size=${size} />
        <${Waypoints} store=${store} at=${at} size=${size} taken=${taken} />
        <${Vessel} store=${store} at=${at} />
        ${aim && html`<g class="aim" transform=${`translate(${at(aim).join(" ")})`}><path d="M-22 0H22M0 -22V22" /><circle r="11" /><text x="14" y="-14">${place(aim)}</text></g>`}
        <${Scale} view=${view} size=${size} />
      </svg>
      <output class="cursor" aria-hidden="true">${cursor ? `x ${number(Math.round(cursor[0] * 10) / 10)}  y ${number(Math.round(cursor[1] * 10) / 10)}${origin ? `  ${latitudeLongitude(cursor, origin)}` : ""}` : ""}</output>
    </div>
    ${placing && html`<p class="hint" role="status">Tap the place of ${placing}, or move the cross with the arrow keys (Shift: farther) and press Enter. Escape leaves it. ${aim ? place(aim) : ""}</p>`}
    <${Words} store=${store} track=${track} />
  </section>`;
}

function told(store, placing, aim) {
  if (placing) return `Chart. Placing ${placing}${aim ? ` at ${place(aim)}` : ""}. Arrow keys move it, Enter places it.`;
  return `Chart of the track, ${store.plan.track.legs.length} legs. Arrow keys move the view, plus and minus zoom.`;
}

/** The same as a table, for whoever cannot see the chart. */
function Words({ store, track }) {
  const { origin } = store.plan.document;
  const numbers = Object.fromEntries(store.plan.document.tasks.map((task, index) => [task.id, index + 1]));
  return html`<details class="words"><summary id="chart-words">The track as a table</summary>
    <table><thead><tr><th scope="col">Step</th><th scope="col">Skill</th><th scope="col">To</th>${origin && html`<th scope="col">Latitude, longitude</th>`}<th scope="col">Way</th><th scope="col">Time</th></tr></thead>
    <tbody>${track.legs.map((leg, i) => html`<tr key=${i}><td>${numbers[leg.task]}.${leg.step + 1}</td><td>${leg.skill || "from its parameters"}</td><td>${leg.points.length ? place(leg.points[leg.points.length - 1]) : "not known"}</td>${origin && html`<td>${leg.points.length > 0 && latitudeLongitude(leg.points[leg.points.length - 1], origin)}</td>`}
      <td>${leg.metres > 0 ? metres(leg.metres) : ""}</td><td>${leg.seconds ? seconds(leg.seconds) : ""}</td></tr>`)}</tbody></table>
    ${track.open.length > 0 && html`<p class="soft">Not known: the way of ${track.open.map((id) => `task ${numbers[id]}`).join(", ")}.</p>`}</details>`;
}
