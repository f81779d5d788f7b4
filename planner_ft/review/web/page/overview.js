// What an operator wants to know first: what is dangerous, how far, how long, how much of the endurance, and where the vehicle ends.

import { count, metres, number, seconds } from "./format.js";
import { SEVERITIES, of, reveal } from "./severity.js";
import { MEANS } from "./sure.js";
import { html } from "./vendor.js";

export function Overview({ store }) {
  const { document, brief } = store.plan;
  const { estimate, vehicle, confidence } = document;
  const share = vehicle?.endurance ? estimate.seconds / vehicle.endurance : null;
  const least = estimate.open.length ? "at least " : "";
  return html`<div class="overview">
    <${Verdict} store=${store} />
    <dl class="figures">
      <div><dt>Way</dt><dd>${least}${metres(estimate.length)}</dd></div>
      <div><dt>Time</dt><dd>${least}${seconds(estimate.seconds)}</dd></div>
      ${share !== null && html`<div class=${share > 1 ? "over" : ""}><dt>Endurance used</dt><dd>${least}${percent(share)} of ${seconds(vehicle.endurance)}${share > 1 ? ": it does not come back" : ""}</dd></div>`}
      <div><dt>Ends</dt><dd>${brief.end}</dd></div>
      ${confidence && html`<div><dt>How sure</dt><dd>${confidence.level ? html`<span class=${`level ${confidence.level}`}>${confidence.level}</span> <small>${MEANS[confidence.level]}</small>` : html`not known <small>${confidence.reason}</small>`}</dd></div>`}
    </dl>
  </div>`;
}

export const percent = (share) => `${number(Math.round(100 * share))}\u00a0%`;

/** Dangers by name, each leading to its warning; cautions and notes as counts. */
function Verdict({ store }) {
  const dangers = of(store, "danger");
  const rest = SEVERITIES.slice(1).map(([severity, one]) => [of(store, severity).length, one]).filter(([n]) => n);
  const others = rest.map(([n, one]) => count(n, one)).join(" and ");
  const led = html`<a href="#warnings" onClick=${(event) => reveal(event, "warnings")}>${others}</a>`;
  if (!store.plan.document.valid && !dangers.length) return html`<p class="verdict danger"><b>Not valid:</b> an agent's answer cannot be used.</p>`;
  if (!dangers.length) return html`<p class="verdict ${rest.length ? "caution" : "calm"}">No danger was found${rest.length ? html`; ${led} to read` : ""}. ${rest.length ? "" : "Read the plan all the same."}</p>`;
  return html`<div class="verdict danger"><b>${count(dangers.length, "danger")}:</b> ${dangers.slice(0, 4).map((one, i) => html`${i ? "; " : ""}<a key=${one.id} href=${`#${one.id}`} onClick=${(event) => reveal(event, one.id)}>${one.name}${one.task ? ` (task ${store.task(one.task).number})` : ""}</a>`)}${dangers.length > 4 ? " and more" : ""}.
    ${rest.length > 0 && html` Also ${led}.`}</div>`;
}
