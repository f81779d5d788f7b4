// Keys of the page. One-letter keys act only where nothing is being written, and can be switched off.

import { Dialog } from "./dialog.js";
import { alternatives, answer } from "./sure.js";
import { html, useState } from "./vendor.js";

const KEYS = [
  ["?", "this list"], ["n", "new command"], ["w", "first warning"], ["1 to 9", "take that answer to a question"], ["o", "the overview of tasks"], ["c", "chart"], ["d", "decision"], ["u", "undo the last change"],
  ["↑ ↓ Home End", "in the list of tasks: from task to task"], ["Enter", "on a task: open or close it; on a value: change it"],
  ["Alt+↑ Alt+↓", "on a task: carry it out earlier or later"], ["Delete", "on a task: remove it"],
  ["arrow keys", "on the chart: move the view; while placing: move the place by a small step, with Shift by a large one"],
  ["+ − 0", "on the chart: nearer, farther, everything"], ["Enter, Escape", "while placing: put the place there, or leave it"],
];

const stored = () => localStorage.getItem("keys") !== "off";

export function Help({ close }) {
  const [on, set] = useState(stored());
  const change = (event) => {
    localStorage.setItem("keys", event.target.checked ? "on" : "off");
    set(event.target.checked);
  };
  return html`<${Dialog} title="Keys" close=${close} wide>
    <dl class="keys">${KEYS.map(([key, what]) => html`<div key=${key}><dt>${key.split(" ").map((part) => html`<kbd>${part}</kbd> `)}</dt><dd>${what}</dd></div>`)}</dl>
    <label class="check"><input type="checkbox" checked=${on} onChange=${change} /> One-letter keys act</label>
    <h3>How to read the plan</h3>
    <p>Begin with the overview: a line per task, with its way, its time, and the endurance that is used when it is done. Red is a danger, amber a caution, grey a note.
      Then read what the plan rests on and what was not checked. A value shows where it comes from: words of the command, a place, a rule, a person's change, or the model itself.
      A value that only the model chose stands apart; check it first.</p>
  <//>`;
}

const GOALS = { w: ["#warnings input:not(:checked)", "#warnings"], o: [".task .head[tabindex='0']"], t: [".task .head[tabindex='0']"], c: ["#chart-view"], d: ["#reviewer"] };

export function shortcut(event, store, show) {
  const writing = event.target.closest("input:not([type=checkbox]), textarea, select, dialog");
  if (writing || event.ctrlKey || event.metaKey || event.altKey || !stored()) return;
  if (event.key === "?") show("help");
  else if (event.key === "n") show("command");
  else if (event.key === "u" && store.plan?.document?.edits.length) store.undo();
  else if (alternatives(store)[event.key - 1]) answer(store, alternatives(store)[event.key - 1]);
  else if (GOALS[event.key]) {
    const goal = GOALS[event.key].map((selector) => document.querySelector(selector)).find(Boolean);
    if (!goal) return;
    goal.focus();
    goal.scrollIntoView({ block: "nearest" });
  } else return;
  event.preventDefault();
}
