// The overview, a line per task in the order of execution: one of them takes the focus, arrows go from one to the next, Alt with arrows moves the task itself.

import { Insert } from "./insert.js";
import { count } from "./format.js";
import { Overview } from "./overview.js";
import { Task } from "./task.js";
import { html, useEffect, useRef, useState } from "./vendor.js";

export function Tasks({ store }) {
  const { tasks } = store.plan.document;
  const [at, setAt] = useState(0);
  const [inserting, insert] = useState(null);
  const [drag, setDrag] = useState(null);
  const list = useRef();
  const current = Math.min(at, tasks.length - 1);
  const chosen = tasks.findIndex((task) => task.id === store.selected?.task);
  useEffect(() => {
    if (chosen >= 0) setAt(chosen);
  }, [chosen]);
  const focus = (index) => {
    setAt(index);
    list.current.querySelectorAll(".head")[index]?.focus();
  };
  const move = async (task, index, to) => {
    if (to < 0 || to >= tasks.length || to === index) return;
    const refused = await store.editOrTell({ kind: "move", task: task.id, to }, `${task.title} is task ${to + 1}`);
    if (!refused) setTimeout(() => focus(to));
  };
  const remove = async (task, index) => {
    const refused = await store.editOrTell({ kind: "remove", task: task.id }, `${task.title} removed`);
    if (!refused) setTimeout(() => (tasks.length > 1 ? focus(Math.max(0, Math.min(index, tasks.length - 2))) : document.getElementById("insert").focus()));
  };
  const keys = (event, task, index) => {
    const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (event.altKey && step) move(task, index, index + step);
    else if (step) focus(Math.max(0, Math.min(index + step, tasks.length - 1)));
    else if (event.key === "Home") focus(0);
    else if (event.key === "End") focus(tasks.length - 1);
    else if (event.key === "Delete") remove(task, index);
    else return;
    event.preventDefault();
  };
  const all = tasks.length > 0 && tasks.every((task) => store.opened[task.id]);
  return html`<section class="panel tasks" id="overview" tabindex="-1" aria-labelledby="tasks-title">
    <header><h2 id="tasks-title">What will happen: ${count(tasks.length, "task")}</h2>
      <button aria-pressed=${all} onClick=${() => store.set({ opened: Object.fromEntries(tasks.map((task) => [task.id, !all])) })}>${all ? "Close all" : "Open all"}</button></header>
    <${Overview} store=${store} />
    ${tasks.length === 0 && html`<p class="soft">The plan has no task. A constraint may say why.</p>`}
    ${tasks.length > 0 && html`<div class="columns" aria-hidden="true"><span class="what">Task</span><span class="way">Way</span><span class="time">Time</span><span class="used" title="Share of the endurance that is used at the end of the task">Used</span></div>`}
    <ol ref=${list} class=${drag ? "dragging" : ""}>${tasks.map((task, index) => html`<${Task} key=${task.id} store=${store} task=${task} index=${index} last=${index === tasks.length - 1}
      tab=${index === current ? 0 : -1} keys=${keys} move=${move} remove=${remove}
      handle=${dragging(list, task, index, setDrag, move)} over=${drag && drag.to === index && drag.from !== index ? (drag.to > drag.from ? "below" : "above") : ""} />`)}</ol>
    <p class="insert"><button id="insert" onClick=${() => insert(chosen >= 0 ? chosen + 1 : tasks.length)}>Insert a task</button></p>
    ${inserting !== null && html`<${Insert} store=${store} at=${inserting} close=${() => insert(null)} />`}
  </section>`;
}

/** Pointer events of a task's handle: the task under the pointer is where it would go. */
function dragging(list, task, from, setDrag, move) {
  let to = from;
  const follow = (event) => {
    const items = [...list.current.children];
    const middle = (item) => item.getBoundingClientRect().top + item.getBoundingClientRect().height / 2;
    const above = items.filter((item, index) => index !== from && middle(item) < event.clientY).length;
    to = above;
    setDrag({ from, to });
  };
  return {
    onPointerDown: (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      const handle = event.currentTarget;
      handle.setPointerCapture(event.pointerId);
      const end = (ended) => {
        for (const [name, listener] of listeners) handle.removeEventListener(name, listener);
        setDrag(null);
        if (ended.type === "pointerup") move(task, from, to);
      };
      const listeners = [["pointermove", follow], ["pointerup", end], ["pointercancel", end]];
      for (const [name, listener] of listeners) handle.addEventListener(name, listener);
    },
  };
}
