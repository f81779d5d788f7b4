// What the reviewer must know before anything moves, each to be acknowledged.

import { count } from "./format.js";
import { Sureness } from "./sure.js";
import { html } from "./vendor.js";

export function Warnings({ store }) {
  const { document } = store.plan;
  const open = store.warnings.filter((warning) => !store.isAcknowledged(warning)).length;
  const title = store.warnings.length === 0 ? "No warnings" : open ? `${count(open, "warning")} to acknowledge` : "All warnings acknowledged";
  return html`<section class="panel warnings" id="warnings" tabindex="-1" aria-labelledby="warnings-title">
    <h2 id="warnings-title">${title}</h2>
    ${!document.valid && html`<p class="refusal">An agent's answer is not valid, so this plan cannot be approved as it is.</p>`}
    ${store.warnings.length === 0 && html`<p class="soft">The checks found nothing. They do not replace reading the plan.</p>`}
    <${Sureness} store=${store} />
    <ul>${store.warnings.map((warning) => html`<${Warning} key=${warning.id} store=${store} warning=${warning} />`)}</ul>
  </section>`;
}

function Warning({ store, warning }) {
  const number = warning.task && store.task(warning.task).number;
  const target = store.plan.document.open_places.find((open) => warning.id === `unresolved-location:${open.name}`);
  const done = store.isAcknowledged(warning);
  return html`<li class=${done ? "done" : ""} data-warning=${warning.id} title=${warning.kind.replaceAll("-", " ")}>
    <label><input type="checkbox" checked=${done} onChange=${(event) => store.acknowledge(warning, event.target.checked)} /><span>${warning.text}</span></label>
    <div class="more">${number > 0 && html`<a href=${`#task-${warning.task}`} onClick=${(event) => show(event, store, warning)} aria-label=${`Show task ${number}${warning.parameter ? `, ${warning.parameter}` : ""}`}>Task ${number}${warning.parameter ? `, ${warning.parameter}` : ""}</a>`}
    ${target && html`<button class="plain" onClick=${() => store.set({ placing: target.name })} aria-label=${`Place ${target.name} on the chart`}>Place it</button>`}</div>
  </li>`;
}

function show(event, store, { task, parameter }) {
  event.preventDefault();
  const { task: entry } = store.task(task);
  store.set({ selected: { task, parameter }, lit: (parameter && entry.sources?.[parameter]?.spans) || [] });
  const goal = document.querySelector(parameter ? `#task-${task} [data-parameter="${CSS.escape(parameter)}"] button` : `#task-${task} .head`) || document.getElementById(`task-${task}`);
  goal.focus({ preventScroll: true });
  goal.scrollIntoView({ block: "center" });
}
