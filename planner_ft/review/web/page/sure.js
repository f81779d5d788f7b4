// How sure the agents were of what they proposed, and the questions that they would have asked.

import { shown } from "./format.js";
import { html } from "./vendor.js";

const MEANS = { sure: "the agents were sure", check: "have a look", unsure: "the agents guessed" };

/** The level of something: nothing where it is sure, or where nothing is known of it. */
export function Level({ of }) {
  return of && of.level !== "sure" ? html` <span class=${`level ${of.level}`} title=${MEANS[of.level]}>${of.level}</span>` : null;
}

/** The least sure level of a task, of its values and of its skills. */
export function leastSure(task) {
  const { task: whole, skills, values = {} } = task.confidence || {};
  const found = [whole, skills, ...Object.values(values)].filter(Boolean);
  return ["unsure", "check"].map((level) => found.find((one) => one.level === level)).find(Boolean);
}

export function Sureness({ store }) {
  const { confidence, choices = [] } = store.plan.document;
  if (!confidence) return null;
  return html`<div class="sureness">
    <p>How sure the agents were: ${confidence.level ? html`<b class=${`level ${confidence.level}`}>${confidence.level}</b>` : html`not known (${confidence.reason})`}</p>
    ${choices.length > 0 && html`<h3>What is meant?</h3><ul>${choices.map((choice) => html`<${Choice} key=${choice.task + choice.parameter} store=${store} choice=${choice} />`)}</ul>`}
  </div>`;
}

function Choice({ store, choice: { task, parameter, others, text } }) {
  const edit = (value) => (parameter === null ? { kind: "title", task, title: value } : { kind: "parameter", task, name: parameter, value });
  return html`<li>${text} ${others.map((value) => html`<button class="plain" key=${shown(value)} aria-label=${`${text} ${shown(value)}`} onClick=${() => store.editOrTell(edit(value), `${text} ${shown(value)}`)}>${shown(value)}</button> `)}</li>`;
}
