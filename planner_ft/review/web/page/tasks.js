// The list of tasks in the order of execution: one of them takes the focus, arrows go from one to the next, Alt with arrows moves the task itself.

import { Insert } from "./insert.js";
import { count } from "./format.js";
import { Task } from "./task.js";
import { html, useEffect, useRef, useState } from "./vendor.js";

export function Tasks({ store }) {
  const { tasks } = store.plan.document;
  const [at, setAt] = useState(0);
  const [inserting, insert] = useState(null);
  const [opened, open] = useState({});
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
  const isOpen = (task) => opened[task.id] ?? (task.skill_sequence || []).length <= 4;
  const all = tasks.every(isOpen);
  return html`<section class="panel tasks" aria-labelledby="tasks-title">
    <header><h2 id="tasks-title">Tasks</h2><span class="soft">${categories(store)}</span><span class="space"></span>
      <button aria-pressed=${all} onClick=${() => open(Object.fromEntries(tasks.map((task) => [task.id, !all])))}>${all ? "Fold steps" : "All steps"}</button>
      <button id="insert" onClick=${() => insert(chosen >= 0 ? chosen + 1 : tasks.length)}>Insert a task</button></header>
    ${tasks.length === 0 && html`<p class="soft">The plan has no task. A constraint may say why.</p>`}
    <ol ref=${list} class=${drag ? "dragging" : ""}>${tasks.map((task, index) => html`<${Task} key=${task.id} store=${store} task=${task} index=${index} last=${index === tasks.length - 1}
      tab=${index === current ? 0 : -1} keys=${keys} move=${move} remove=${remove} open=${isOpen(task)} toggle=${() => open({ ...opened, [task.id]: !isOpen(task) })}
      handle=${dragging(list, task, index, setDrag, move)} over=${drag && drag.to === index && drag.from !== index ? (drag.to > drag.from ? "below" : "above") : ""} />`)}</ol>
    ${inserting !== null && html`<${Insert} store=${store} at=${inserting} close=${() => insert(null)} />`}
  </section>`;
}

function categories(store) {
  const { vocabulary, document } = store.plan;
  const counts = {};
  for (const task of document.tasks) {
    const category = vocabulary.tasks.find((one) => one.title === task.title)?.category || "unknown";
    counts[category] = (counts[category] || 0) + 1;
  }
  return `${count(document.tasks.length, "task")}: ${Object.entries(counts).map(([category, n]) => `${n} ${category}`).join(", ")}`;
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
