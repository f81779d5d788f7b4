// A new command, and the agents at work on it: tasks first, then the steps of one task after the other.

import { Dialog, Refusal } from "./dialog.js";
import { count, same, shown } from "./format.js";
import { html, useLayoutEffect, useRef, useState } from "./vendor.js";

export function NewCommand({ store, close }) {
  const { planner, busy, document } = store.plan;
  const [text, write] = useState("");
  const [refused, refuse] = useState(null);
  const field = useRef();
  useLayoutEffect(() => field.current && field.current.focus(), []);
  const [asked, ask] = useState(null); // a question about the text, and whether it was answered with yes
  const send = async (event, sure = false) => {
    event.preventDefault();
    const refusal = await store.command(text, sure);
    if (!refusal) return close();
    ask(refusal.question ? text : null);
    return refuse(refusal.error);
  };
  const keys = (event) => (event.ctrlKey || event.metaKey) && event.key === "Enter" && send(event);
  return html`<${Dialog} title="New command" close=${close} wide>
    <form onSubmit=${send}>
      <label for="command-text">What is to be done? Say the objective, the place, what to record, and the limits.</label>
      <textarea id="command-text" ref=${field} rows="6" value=${text} disabled=${!planner.available} onInput=${(event) => write(event.target.value)} onKeyDown=${keys}
        aria-describedby="command-refused" placeholder="Find the green buoy, circle it at 12 m with video, come home."></textarea>
      <p class="soft">${planner.available ? `${[planner.candidate, planner.configuration].filter(Boolean).join(", ")}. A new plan is saved beside the others, never over one.` : planner.why}</p>
      <${Refusal} id="command-refused" text=${refused} />
      ${asked === text && html`<p class="buttons"><button type="button" class="act" onClick=${(event) => send(event, true)}>Plan what can be read</button></p>`}
      <p class="buttons">${document && html`<button type="button" onClick=${() => write(document.command)}>Take the command shown</button>`}
        <button class="act" disabled=${!planner.available || Boolean(busy)}>${busy ? "The agents are at work" : "Plan it"}</button></p>
    </form>
  <//>`;
}

export function Progress({ store }) {
  const { busy } = store.plan;
  const { tasks, skills } = store.draft;
  const ready = tasks ? Object.keys(skills).length : 0;
  return html`<section class="panel progress" aria-labelledby="progress-title">
    <h2 id="progress-title">The agents are planning</h2>
    ${busy.command && html`<blockquote class="command">${busy.command}</blockquote>`}
    <p role="status" aria-live="polite">${busy.label}${busy.total > 0 ? `: ${busy.done} of ${count(busy.total, "task")} have their steps` : ""}</p>
    <progress max=${busy.total || 1} value=${busy.total ? busy.done : null} aria-label="Tasks with steps"></progress>
    ${tasks && html`<ol class="draft" aria-label=${`${tasks.length} tasks, ${ready} with steps`}>${tasks.map((task, index) => html`<${Draft} key=${index} task=${task} number=${index + 1} unresolved=${store.plan.vocabulary.unresolved} steps=${skills[task.id || `t${index + 1}`]} />`)}</ol>`}
  </section>`;
}

function Draft({ task, number, steps, unresolved }) {
  const names = steps && steps.map((step) => step.navigation_skill.name);
  return html`<li class=${steps ? "ready" : ""}><b>${number} ${task.title}</b>${" "}
    <span class="soft">${Object.entries(task.parameters).map(([name, value]) => `${name} ${same(value, unresolved) ? "place not known" : shown(value)}`).join(" · ")}</span>
    <span class="steps">${task.waits_for ? `waits for the place of ${task.waits_for}` : !names ? "…" : names.length ? `${count(names.length, "step")}: ${names.slice(0, 6).join(", ")}${names.length > 6 ? " …" : ""}` : "no steps"}</span></li>`;
}
