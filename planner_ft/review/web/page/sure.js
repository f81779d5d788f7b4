// How sure the agents were of what they proposed, and the questions that they would have asked.

import { shown } from "./format.js";
import { html } from "./vendor.js";

export const MEANS = { sure: "the agents were sure", check: "have a look", unsure: "the agents guessed" };

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

/** Every alternative of every question, in order: its place is the key that takes it. */
export const alternatives = (store) => (store.plan?.document?.choices || []).flatMap((choice) => choice.others.map((value) => ({ choice, value }))).slice(0, 9);

export function Questions({ store }) {
  const { choices = [] } = store.plan.document;
  const keys = alternatives(store);
  if (!choices.length) return null;
  return html`<div class="asked"><h3>What is meant?</h3>
    <ul>${choices.map((choice) => html`<li key=${choice.task + choice.parameter}><bdi>${choice.text}</bdi>
      <ul class="answers">
        <li><b>${said(store, choice, choice.value)}</b> <small>as planned</small></li>
        ${choice.others.map((value) => {
          const key = keys.findIndex((one) => one.choice === choice && one.value === value) + 1;
          return html`<li key=${shown(value)}><button aria-label=${`${choice.text} ${shown(value)}`} title="Changes the task and plans its steps again" onClick=${() => answer(store, { choice, value })}>${key > 0 && html`<kbd>${key}</kbd> `}${said(store, choice, value)}</button></li>`;
        })}</ul></li>`)}</ul></div>`;
}

/** A value, or a task with what it does. */
function said(store, choice, value) {
  const task = choice.parameter === null && store.plan.vocabulary.tasks.find((one) => one.title === value);
  return task ? html`${task.title}<span class="does">: ${task.description}</span>` : shown(value);
}

/** Takes an alternative and has the steps of its task planned again, where they can be. */
export async function answer(store, { choice: { task, parameter, text }, value }) {
  const edit = parameter === null ? { kind: "title", task, title: value } : { kind: "parameter", task, name: parameter, value };
  const refused = await store.editOrTell(edit, `${text} ${shown(value)}`);
  const { task: entry, number } = store.task(task);
  if (refused || !entry || entry.waits_for || entry.asks || !store.plan.planner.available || store.plan.busy) return;
  store.skillsAgain(task, `task ${number}, ${entry.title}`);
}
