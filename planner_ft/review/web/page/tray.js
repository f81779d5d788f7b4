// Places beside the chart: those that are not known wait here, to be dragged, tapped, moved by keys or typed onto it.

import { Refusal } from "./dialog.js";
import { place, tasksNamed } from "./format.js";
import { html, useEffect, useRef, useState } from "./vendor.js";
import { parse } from "./values.js";

export function Tray({ store, drop }) {
  const { document } = store.plan;
  const located = Object.entries(document.located);
  if (!document.open_places.length && !located.length) return null;
  return html`<div class="tray">
    ${document.open_places.length > 0 && html`<div class="waiting"><h3>Places that are not known: put them on the chart</h3>
      <ul>${document.open_places.map((open) => html`<${Target} key=${open.name} store=${store} name=${open.name} drop=${drop} tasks=${open.tasks.map((number) => document.tasks[number - 1].id)} />`)}</ul></div>`}
    ${located.length > 0 && html`<div class="placed"><h3>Places</h3>
      <ul>${located.map(([name, position]) => html`<${Target} key=${name} store=${store} name=${name} position=${position} drop=${drop} tasks=${[]} />`)}</ul></div>`}
  </div>`;
}

function Target({ store, name, position, drop, tasks }) {
  const [text, write] = useState("");
  const [refused, refuse] = useState(null);
  const placing = store.placing === name;
  const chip = useRef();
  useEffect(() => (chip.current ? dragged(chip.current, name, drop) : undefined), [name, drop]);
  const type = async (event) => {
    event.preventDefault();
    refuse(await store.edit({ kind: "locate", name, position: parse("position", text) }, `${name} placed`));
  };
  const id = `at-${name}`;
  return html`<li class=${placing ? "chosen" : ""}>
    <button ref=${chip} class="chip" aria-pressed=${placing} title="Drag onto the chart, or press and then choose the place" onClick=${() => store.set({ placing: placing ? null : name, notice: placing ? "" : `Choose the place of ${name} on the chart.` })}>
      <svg viewBox="-10 -10 20 20" aria-hidden="true"><path d="M0 -9L9 0L0 9L-9 0Z" /></svg><bdi>${name}</bdi>${position && html` <span class="at">${place(position)}</span>`}</button>
    ${tasks.length > 0 && html`<span class="soft">needed by ${tasksNamed(tasks, store.plan.document.tasks)}</span>`}
    <form onSubmit=${type}><label class="unseen" for=${id}>${`Position of ${name}: x, y in metres`}</label>
      <input id=${id} type="text" class="position" placeholder="x, y" autocomplete="off" value=${text} onInput=${(event) => write(event.target.value)} aria-describedby=${`${id}-refused`} /><span class="unit">m</span>
      <button>${position ? "Move" : "Place"}</button></form>
    <${Refusal} id=${`${id}-refused`} text=${refused} />
  </li>`;
}

/** Dragging by pointer: `drop(name, x, y, done)` is told the client coordinates on the way and at the end. A short press stays a press. */
function dragged(chip, name, drop) {
  let from = null;
  let far = false;
  const start = (event) => {
    if (event.button !== 0) return;
    from = [event.clientX, event.clientY];
    far = false;
    chip.setPointerCapture(event.pointerId);
  };
  const move = (event) => {
    if (!from) return;
    far = far || Math.hypot(event.clientX - from[0], event.clientY - from[1]) > 8;
    if (far) drop(name, event.clientX, event.clientY, false);
  };
  const end = (event) => {
    if (from && far && event.type === "pointerup") drop(name, event.clientX, event.clientY, true);
    else if (from && far) drop(name, -1, -1, true);
    from = null;
  };
  const click = (event) => {
    if (!far) return;
    event.stopImmediatePropagation();
    far = false;
  };
  const listeners = [["pointerdown", start], ["pointermove", move], ["pointerup", end], ["pointercancel", end]];
  for (const [kind, listener] of listeners) chip.addEventListener(kind, listener);
  chip.addEventListener("click", click, { capture: true });
  return () => {
    for (const [kind, listener] of listeners) chip.removeEventListener(kind, listener);
    chip.removeEventListener("click", click, { capture: true });
  };
}
