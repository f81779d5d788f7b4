// The steps of a task: in each, what moves the vehicle, what constrains it and what gathers run together, side by side.

import { metres, seconds } from "./format.js";
import { html } from "./vendor.js";
import { Add, Value, unknownParameter } from "./values.js";

const ROLES = [["navigation", "Navigation"], ["filter", "Filters"], ["perception", "Perception and data"]];

const WHOSE = { vehicle: "vehicle's", limit: "limit", clearance: "clearance" };

export const skillsOf = (step, role) => (role === "navigation" ? [step.navigation_skill] : role === "filter" ? step.filter_skills : step.perception_skills);

export function Steps({ store, task, number }) {
  const legs = store.plan.track?.legs.filter((leg) => leg.task === task.id) || [];
  return html`<table class="steps">
    <caption class="unseen">Steps of task ${number}; what stands in one row runs together</caption>
    <thead><tr><th scope="col">Step</th>${ROLES.map(([role, name]) => html`<th key=${role} scope="col">${name}</th>`)}</tr></thead>
    <tbody>${task.skill_sequence.map((step, index) => html`<${Step} key=${index} store=${store} task=${task} number=${number} step=${step} index=${index} legs=${legs.filter((leg) => leg.step === index)} />`)}</tbody>
  </table>`;
}

function Step({ store, task, number, step, index, legs }) {
  const chosen = store.selected?.task === task.id && store.selected.step === index;
  const way = legs.reduce((sum, leg) => sum + leg.metres, 0);
  const time = legs.reduce((sum, leg) => sum + leg.seconds, 0);
  const texts = [["until", step.stop_conditions], ["fails if", step.failure_modes], ["gives", step.expected_outputs]].filter(([, rows]) => rows?.length);
  return html`<tr class=${chosen ? "chosen" : ""} data-step=${index}>
    <th scope="row" rowspan=${texts.length ? 2 : 1}><button class="plain step" aria-pressed=${chosen} title="Show this step on the chart" onClick=${() => store.select({ task: task.id, step: index })}>${number}.${index + 1}</button>
      ${(way > 0 || time > 0) && html`<small>${way > 0 ? metres(way) : seconds(time)}</small>`}</th>
    ${ROLES.map(([role, name]) => html`<td key=${role} data-role=${name}>
      ${skillsOf(step, role).map((skill, i) => html`<${Skill} key=${`${skill.name} ${i}`} store=${store} task=${task} where=${{ step: index, role, index: i }} skill=${skill} label=${`${number}.${index + 1} ${skill.name}`} />`)}</td>`)}
  </tr>
  ${texts.length > 0 && html`<tr class=${`texts ${chosen ? "chosen" : ""}`}><td colspan="3">${texts.map(([what, rows]) => html`<span key=${what}><b>${what}</b> ${rows.join(", ")}</span>`)}</td></tr>`}`;
}

/** A name that may be broken between its words, as in Boundary|Enforcement. */
const parts = (name) => name.split(/(?<=[a-z])(?=[A-Z])/).flatMap((word, i) => (i ? [html`<wbr />`, word] : [word]));

function Skill({ store, task, where, skill, label }) {
  const known = store.plan.vocabulary.skills[skill.name]?.parameters || [];
  const change = (name, value) => store.edit({ kind: "skill", task: task.id, ...where, name, value }, `${label} ${name}`);
  const mark = (task.added || []).find((one) => one.step === where.step && one.name === skill.name);
  const drop = () => store.editOrTell({ kind: "drop", task: task.id, step: where.step, name: skill.name }, `${label} left out`);
  return html`<div class="skill"><span class="name" title=${store.plan.vocabulary.skills[skill.name]?.description}>${parts(skill.name)}</span>
    ${mark && html`<span class=${`source of-${mark.kind}`} title=${mark.note || "Added behind the Task Agent"}>${WHOSE[mark.kind]}${mark.parameter ? ` ${mark.parameter}` : ""}</span>`}
    ${where.role !== "navigation" && html`<button class="plain" aria-label=${`Leave out ${label}`} title="Leave out; undo brings it back" onClick=${drop}>✕</button>`}
    <${Add} short store=${store} label=${label} known=${known} given=${skill.parameters} change=${change} />
    ${Object.entries(skill.parameters).map(([name, value]) => html`<span key=${name} class="parameter"><span class="key">${name}</span>
      <${Value} store=${store} label=${label} parameter=${known.find((one) => one.name === name) || unknownParameter(name, value)} value=${value} change=${(next) => change(name, next)} /></span>`)}</div>`;
}
