// Estimate, assumptions, constraints, and what the plan was made with.

import { metres, number, seconds, tasksNamed } from "./format.js";
import { html } from "./vendor.js";

export function Facts({ store }) {
  const { assumptions, constraints, limits = [], origin } = store.plan.document;
  return html`<section class="panel facts" aria-labelledby="facts-title">
    <h2 id="facts-title">Estimate</h2>
    <${Estimate} store=${store} />
    <${Texts} title="The model takes for granted" texts=${assumptions} none="nothing" />
    <${Texts} title="The mission fails if this is violated" texts=${constraints.map((text) => explained(text, limits))} none="no constraint was named" />
    ${origin && html`<h3>Where [0, 0] lies</h3><p>${number(Math.abs(origin.latitude))}° ${origin.latitude < 0 ? "S" : "N"}, ${number(Math.abs(origin.longitude))}° ${origin.longitude < 0 ? "W" : "E"}</p>`}
  </section>`;
}

/** A constraint; a limit with the words that it came from, what keeps it, and whether it is checked. */
function explained(text, limits) {
  const limit = limits.find((one) => one.text === text);
  const notes = limit && [limit.words && `from “${limit.words}”`, limit.filter && `kept by ${limit.filter}`, limit.unchecked && `not checked: ${limit.unchecked}`].filter(Boolean);
  return notes?.length ? `${text} (${notes.join("; ")})` : text;
}

const Texts = ({ title, texts, none }) => html`<h3>${title}</h3>${texts.length ? html`<ul>${texts.map((text) => html`<li>${text}</li>`)}</ul>` : html`<p class="soft">${none}</p>`}`;

function Estimate({ store }) {
  const { estimate, vehicle, tasks } = store.plan.document;
  const share = vehicle?.endurance ? estimate.seconds / vehicle.endurance : null;
  const over = share > 1;
  return html`<dl class="figures">
      <div><dt>Way</dt><dd>${estimate.open.length ? "at least " : ""}${metres(estimate.length)}</dd></div>
      <div><dt>Time</dt><dd>${estimate.open.length ? "at least " : ""}${seconds(estimate.seconds)}</dd></div>
      ${share !== null && html`<div><dt>Endurance</dt><dd>${seconds(vehicle.endurance)}</dd></div>`}
    </dl>
    ${estimate.away && html`<p class="soft">Ends ${metres(estimate.away)} from home.</p>`}
    ${share !== null && html`<div class=${`meter ${over ? "over" : ""}`} role="meter" aria-label="Share of the endurance" aria-valuemin="0" aria-valuemax="100" aria-valuenow=${Math.round(100 * share)}>
      <svg viewBox="0 0 100 6" preserveAspectRatio="none" aria-hidden="true"><rect width=${Math.min(100 * share, 100)} height="6" /></svg>
      <span>${estimate.open.length ? "at least " : ""}${number(Math.round(1000 * share) / 10)} % of the endurance${over ? ": the vehicle does not come back" : ""}</span></div>`}
    ${estimate.open.length > 0 && html`<p class="soft">Not counted, because their way is not known: ${tasksNamed(estimate.open, tasks)}.</p>`}
    ${vehicle && html`<p class="soft">At ${number(vehicle.cruise_speed)} m/s, the profile of ${vehicle.name}.</p>`}`;
}

/** Models, adapters, versions, edits: there for whoever asks, closed at first. */
export function Provenance({ store }) {
  const { document, path } = store.plan;
  const { usage, manifest } = document;
  const agents = Object.entries(usage || {}).map(([level, use]) => [`${level} agent`, [use.candidate, use.configuration, use.adapter || "no adapter", `${use.tokens} tokens, ${number(use.seconds)} s`].join(" · ")]);
  const hashes = Object.entries(manifest?.agents || {}).flatMap(([level, agent]) => Object.entries(agent).filter(([key]) => key.endsWith("sha256")).map(([key, hash]) => [`${level} ${key}`, hash]));
  const rows = [
    ["file", path], ["digest", document.digest], ["vocabulary", `${document.vocabulary.name} ${document.vocabulary.sha256}`], ...agents, ...hashes,
    ["planned", manifest?.created], ["planner_ft", manifest?.planner_ft], ["commit", manifest?.commit], ["device", manifest?.device],
    ...Object.entries(manifest?.versions || {}),
  ];
  return html`<details class="panel provenance"><summary><h2>Models and provenance</h2></summary>
    <dl>${rows.filter(([, value]) => value).map(([name, value]) => html`<div key=${name}><dt>${name}</dt><dd>${String(value)}</dd></div>`)}</dl>
    <h3>Changes made here</h3>
    ${document.edits.length === 0 ? html`<p class="soft">none</p>` : html`<ol>${document.edits.map((record) => html`<li>${record.time} ${record.by || ""} <code>${JSON.stringify(record.edit)}</code></li>`)}</ol>`}
  </details>`;
}
