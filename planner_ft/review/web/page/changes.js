// What differs from the model's proposal, and the way back.

import { count, shown, when } from "./format.js";
import { html } from "./vendor.js";

export const value = (kind, it) => {
  if (it === null || it === undefined) return "nothing";
  if (kind === "skills") return count(it.length, "step");
  if (typeof it === "object" && !Array.isArray(it)) return Object.entries(it).map(([name, part]) => `${name} ${shown(part)}`).join(", ") || "no parameters";
  return shown(it);
};

export function title(change, store) {
  if (!change.task) return change.name;
  const { task, number } = store.task(change.task);
  const called = task ? `${number} ${task.title}` : change.name;
  return { added: `${called} added`, removed: `${change.name} removed`, moved: `${called} moved`, prompt: `${called}, what the Task Agent is told`, skills: `${called}, steps` }[change.kind] || `${called}, ${change.name}`;
}

export function Changes({ store }) {
  const { differences, document } = store.plan;
  const last = document.edits[document.edits.length - 1];
  return html`<section class="panel changes" aria-labelledby="changes-title">
    <header><h2 id="changes-title">Changes</h2>
      <button disabled=${!last} title="Takes the last change back (u)" onClick=${() => store.undo()}>Undo</button></header>
    ${differences.length === 0 && html`<p class="soft">None: this is what the model proposed.</p>`}
    <ul>${differences.map((change) => html`<li key=${change.text}>
      <b>${title(change, store)}</b>
      <span class="sides"><del>${value(change.kind, change.before)}</del><span class="unseen"> became </span><span aria-hidden="true"> → </span><ins>${value(change.kind, change.after)}</ins></span>
      ${change.by && html`<small>changed by <bdi>${change.by}</bdi></small>`}</li>`)}</ul>
    ${last && html`<p class="soft">Last of ${count(document.edits.length, "change")}${last.by ? ` by ${last.by}` : ""}: ${when(last.time)}</p>`}
  </section>`;
}
