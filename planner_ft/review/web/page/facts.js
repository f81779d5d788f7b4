// What the plan rests on: what is taken for granted, what must hold, what nobody checked; and what it was made with.

import { latitudeLongitude, number, when } from "./format.js";
import { html } from "./vendor.js";

export function Facts({ store }) {
  const { constraints, limits = [], origin, vehicle, ontology } = store.plan.document;
  const { assumed, unchecked } = store.plan.brief;
  return html`<section class="panel facts" aria-labelledby="facts-title">
    <h2 id="facts-title">What the plan rests on</h2>
    <${Texts} title="Taken for granted" texts=${assumed} none="nothing" />
    <${Texts} title="Constraints: the mission fails if one is broken" texts=${constraints.map((text) => explained(text, limits))} none="none" />
    <${Texts} title="Not checked" texts=${unchecked} none="nothing" id="not-checked" />
    ${ontology.questions.length > 0 && html`<${Texts} title="The command leaves open" texts=${ontology.questions} />`}
    <h3>Where and with what</h3>
    <p class="soft">${origin ? `[0, 0] lies at ${latitudeLongitude([0, 0], origin)}. ` : ""}${vehicle ? `Times are at ${number(vehicle.cruise_speed)} m/s, from the profile of ${vehicle.name}.` : ""}</p>
  </section>`;
}

/** A constraint; a limit with the words that it came from, and what keeps it. */
function explained(text, limits) {
  const limit = limits.find((one) => one.text === text);
  const notes = limit && [limit.words && `from “${limit.words}”`, limit.filter && `kept by ${limit.filter}`].filter(Boolean);
  return notes?.length ? `${text} (${notes.join("; ")})` : text;
}

const Texts = ({ title, texts, none, id }) => html`<h3 id=${id}>${title}</h3>${texts.length ? html`<ul>${texts.map((text) => html`<li key=${text}><bdi>${text}</bdi></li>`)}</ul>` : html`<p class="soft">${none}</p>`}`;

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
  return html`<details class="panel provenance"><summary><h2>Models and every change</h2></summary>
    <dl>${rows.filter(([, value]) => value).map(([name, value]) => html`<div key=${name}><dt>${name}</dt><dd>${String(value)}</dd></div>`)}</dl>
    <h3>Changes in order</h3>
    ${document.edits.length === 0 ? html`<p class="soft">none</p>` : html`<ol>${document.edits.map((record) => html`<li>${when(record.time)} ${record.by || "(no name)"} <code>${JSON.stringify(record.edit)}</code></li>`)}</ol>`}
  </details>`;
}
