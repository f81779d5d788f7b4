// Carrying the approved plan out in the simulator: start, watch, abort, replay. What it draws on the chart is here as well.

import { get } from "./api.js";
import { number } from "./format.js";
import { html, useEffect, useState } from "./vendor.js";

const REPLAY = 10; // simulated seconds in one second of a replay

/** Takes a frame of the run that is on. */
export function watched(store, frame) {
  const before = store.watch?.frames || [];
  const fresh = !before.length || before[before.length - 1].t >= frame.t;
  const frames = fresh ? [] : before;
  const last = frames[frames.length - 1];
  frames.push(frame);
  store.set({ watch: { ...store.watch, frames, at: null } });
  if (!last || last.task !== frame.task || last.step !== frame.step) show(store, frame);
}

/** Highlights the step of a frame in the list and on the chart; the way home is in no task. */
function show(store, frame) {
  const known = store.plan?.document?.tasks.some((task) => task.id === frame.task);
  store.select(known ? { task: frame.task, step: frame.step } : null);
}

const shownFrame = ({ watch }) => watch?.frames[watch.at ?? watch.frames.length - 1];

const clock = (seconds) => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, "0")}`;

export function Run({ store }) {
  const { run, approval, path } = store.plan;
  const [refused, refuse] = useState(null);
  const own = run.status && run.plan === path;
  useEffect(() => {
    if (!own) return store.set({ watch: null });
    if (store.watch?.folder === run.folder) return undefined;
    const waiting = { frames: [], at: null, folder: run.folder };
    store.set({ watch: waiting });
    get("/api/track").then(({ frames }) => store.watch?.frames.length || store.set({ watch: { ...waiting, frames } }), () => undefined);
  }, [own && run.folder]);
  useEffect(() => refuse(null), [run.status, approval.status]);
  if (!run.available || (!own && approval.status !== "approved")) return null;
  const on = run.status === "running";
  return html`<section class="panel run" aria-labelledby="run-title">
    <header><h2 id="run-title">${own && !on ? "Replay of the simulated run" : "Simulated run"}</h2></header>
    ${own && html`<${Now} store=${store} on=${on} />`}
    ${own && !on && html`<${Replay} store=${store} />`}
    ${on ? html`<button class="abort" id="abort" onClick=${async () => refuse(await store.ask("/api/abort", { name: await nameOf(store) }, "The run is aborted."))}>Abort: stop at once</button>`
      : approval.status === "approved" && html`<${Start} store=${store} refuse=${refuse} again=${own} />`}
    ${refused && html`<p class="refusal" role="alert">${refused}</p>`}
  </section>`;
}

const nameOf = async (store) => ((store.reviewer ?? sessionStorage.getItem("reviewer")) || "").trim();

function Start({ store, refuse, again }) {
  const [speed, set] = useState(10);
  const start = async (event) => {
    event.preventDefault();
    const name = store.whose ? await store.whose() : await nameOf(store);
    if (!name) {
      document.getElementById("reviewer")?.focus();
      return refuse("A run stands in the log under your name; write it below.");
    }
    return refuse(await store.change("/api/run", { name, speed }, "run", { repeat: false, done: "The run has begun." }));
  };
  return html`<form class="start" onSubmit=${start}>
    <button class="act" id="run">${again ? "Run it again" : "Run it in the simulator"}</button>
    <label>Speed <select value=${speed} onChange=${(event) => set(Number(event.target.value))}>${store.plan.run.speeds.map((one) => html`<option key=${one} value=${one}>${one} ×</option>`)}</select></label>
    <span class="soft">Nothing real moves: current and noise are drawn, and the run stands in the log.</span></form>`;
}

/** Task, step and skills that are active, time, and how it ended. */
function Now({ store, on }) {
  const { run, document: { tasks } } = store.plan;
  const frame = shownFrame(store);
  const ended = !on && html`<p class=${`ended ${run.status}`} role="status">${run.status === "done" ? `Done: every step ended as planned${run.reason ? `, but ${run.reason}` : ""}.` : `Ended: ${run.status}${run.reason ? `, ${run.reason}` : ""}.`} <span class="soft">Files: ${run.folder}</span></p>`;
  if (!frame) return ended || html`<p role="status">The run begins.</p>`;
  const index = tasks.findIndex((task) => task.id === frame.task);
  const what = index < 0 ? "On the way home" : `Task ${index + 1}, ${tasks[index].title}: step ${frame.step + 1} of ${tasks[index].skill_sequence.length}`;
  const total = frame.t + frame.left;
  return html`${ended}
    <p class="what" role=${on ? "status" : null}><b>${what}</b></p>
    <ul class="active" aria-label="Active skills">${frame.skills.map((skill, i) => html`<li key=${`${skill} ${i}`} class=${i ? "" : "moving"}>${skill}</li>`)}</ul>
    <progress max=${total || 1} value=${frame.t} aria-label="Time of the run"></progress>
    <dl><div><dt>Elapsed</dt><dd class="elapsed">${clock(frame.t)}</dd></div><div><dt>Remaining, about</dt><dd class="left">${clock(frame.left)}</dd></div>
      <div><dt>At</dt><dd>x ${number(frame.pose[0])}, y ${number(frame.pose[1])}</dd></div></dl>`;
}

function Replay({ store }) {
  const { frames, at } = store.watch || { frames: [] };
  const [playing, play] = useState(false);
  const last = frames.length - 1;
  const now = at ?? last;
  const go = (index) => {
    const before = frames[now];
    store.set({ watch: { ...store.watch, at: index } });
    if (frames[index] && (frames[index].task !== before?.task || frames[index].step !== before?.step)) show(store, frames[index]);
  };
  useEffect(() => {
    if (!playing) return undefined;
    if (now >= last) return play(false);
    const wait = Math.min(1000, ((frames[now + 1].t - frames[now].t) / REPLAY) * 1000);
    const timer = setTimeout(() => go(now + 1), wait);
    return () => clearTimeout(timer);
  }, [playing, now]);
  if (last < 1) return null;
  const press = () => {
    if (!playing && now >= last) go(0);
    play(!playing);
  };
  return html`<div class="replay"><button id="replay" aria-pressed=${playing} onClick=${press}>${playing ? "Pause" : "Replay"}</button>
    <input type="range" min="0" max=${last} value=${now} aria-label="Moment of the run" aria-valuetext=${clock(frames[now].t)} onInput=${(event) => (play(false), go(Number(event.target.value)))} /></div>`;
}

/** The vehicle and the way that it has come, on the chart. */
export function Vessel({ store, at }) {
  const frame = shownFrame(store);
  if (!frame) return null;
  const { frames, at: now } = store.watch;
  const trail = frames.slice(0, (now ?? frames.length - 1) + 1).map(({ pose }) => at(pose).map((part) => part.toFixed(1)).join(","));
  const [x, y] = at(frame.pose);
  return html`<g class="vessel" aria-hidden="true"><polyline points=${trail.join(" ")} />
    <path data-pose=${frame.pose.join(" ")} d="M14 0L-8 8L-4 0L-8 -8Z" transform=${`translate(${x} ${y}) rotate(${(-frame.pose[2] * 180) / Math.PI})`} /></g>`;
}
