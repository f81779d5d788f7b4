// What the reviewer must know before anything moves: questions, then dangers, cautions and notes, each to be acknowledged.

import { count } from "./format.js";
import { SEVERITIES, of } from "./severity.js";
import { Questions } from "./sure.js";
import { html } from "./vendor.js";

export function Warnings({ store }) {
  const { document } = store.plan;
  const open = store.warnings.filter((warning) => !store.isAcknowledged(warning)).length;
  const title = store.warnings.length === 0 ? "No warnings" : open ? `${count(open, "warning")} to acknowledge` : "All warnings acknowledged";
  const notes = of(store, "note").filter((warning) => !store.isAcknowledged(warning));
  return html`<section class="panel warnings" id="warnings" tabindex="-1" aria-labelledby="warnings-title">
    <h2 id="warnings-title">${title}</h2>
    ${!document.valid && html`<p class="refusal">An agent's answer is not valid, so this plan cannot be approved as it is.</p>`}
    ${store.warnings.length === 0 && html`<p class="soft">The checks found nothing. They do not replace reading the plan.</p>`}
    ${!store.plan.tampered && html`<${Questions} store=${store} />`}
    ${SEVERITIES.map(([severity, one]) => of(store, severity).length > 0 && html`<h3 key=${severity} class=${severity}>${count(of(store, severity).length, one)}</h3>
      <ul>${of(store, severity).map((warning) => html`<${Warning} key=${warning.id} store=${store} warning=${warning} />`)}</ul>`)}
    ${notes.length > 1 && html`<p><button onClick=${() => notes.forEach((warning) => store.acknowledge(warning, true))}>Acknowledge all notes</button></p>`}
  </section>`;
}

function Warning({ store, warning }) {
  const number = warning.task && store.task(warning.task).number;
  const place = store.plan.document.open_places.find((open) => warning.id === `unresolved-location:${open.name}`);
  const done = store.isAcknowledged(warning);
  return html`<li class=${`${warning.severity} ${done ? "done" : ""}`} data-warning=${warning.id}>
    <label><input type="checkbox" checked=${done} onChange=${(event) => store.acknowledge(warning, event.target.checked)} /><span><b>${warning.name}</b> <bdi>${warning.text}</bdi></span></label>
    <div class="more">${number > 0 && html`<a href=${`#task-${warning.task}`} onClick=${(event) => show(event, store, warning)} aria-label=${`Show task ${number}${warning.parameter ? `, ${warning.parameter}` : ""}`}>Task ${number}${warning.parameter ? `, ${warning.parameter}` : ""}</a>`}
    ${place && html`<button class="plain" onClick=${() => store.set({ placing: place.name })} aria-label=${`Put ${place.name} on the chart`}>Put it on the chart</button>`}</div>
  </li>`;
}

function show(event, store, { task, parameter }) {
  event.preventDefault();
  const { task: entry } = store.task(task);
  store.set({ selected: { task, parameter }, lit: (parameter && entry.sources?.[parameter]?.spans) || [], opened: { ...store.opened, [task]: true } });
  setTimeout(() => {
    const goal = document.querySelector(parameter ? `#task-${task} [data-parameter="${CSS.escape(parameter)}"] button` : `#task-${task} .head`) || document.getElementById(`task-${task}`);
    goal.focus({ preventScroll: true });
    goal.scrollIntoView({ block: "center" });
  });
}
