// Keys of the page. One-letter keys act only where nothing is being written, and can be switched off.

import { Dialog } from "./dialog.js";
import { html, useState } from "./vendor.js";

const KEYS = [
  ["?", "this list"], ["n", "new command"], ["w", "first warning"], ["t", "tasks"], ["c", "chart"], ["d", "decision"], ["u", "undo the last change"],
  ["↑ ↓ Home End", "in the list of tasks: from task to task"], ["Enter", "on a task: show or hide its steps; on a value: change it"],
  ["Alt+↑ Alt+↓", "on a task: carry it out earlier or later"], ["Delete", "on a task: remove it"],
  ["arrow keys", "on the chart: move the view; while placing: move the target by a small step, with Shift by a large one"],
  ["+ − 0", "on the chart: nearer, farther, everything"], ["Enter, Escape", "while placing: put the target there, or leave it"],
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
    <p>Begin with the warnings. A value shows where it comes from: the words of the command, a place that was located, a rule, an operator's change, or the model itself.
      A value that only the model chose stands apart; check it first.</p>
  <//>`;
}

const GOALS = { w: ["#warnings input:not(:checked)", "#warnings"], t: [".task .head[tabindex='0']"], c: ["#chart-view"], d: ["#reviewer"] };

export function shortcut(event, store, show) {
  const writing = event.target.closest("input:not([type=checkbox]), textarea, select, dialog");
  if (writing || event.ctrlKey || event.metaKey || event.altKey || !stored()) return;
  if (event.key === "?") show("help");
  else if (event.key === "n") show("command");
  else if (event.key === "u" && store.plan?.document?.edits.length) store.undo();
  else if (GOALS[event.key]) {
    const goal = GOALS[event.key].map((selector) => document.querySelector(selector)).find(Boolean);
    if (!goal) return;
    goal.focus();
    goal.scrollIntoView({ block: "nearest" });
  } else return;
  event.preventDefault();
}
