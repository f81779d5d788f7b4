// One task: a line of the overview; opened, its values with where each comes from, its steps, and what can be done to it.

import { Refusal } from "./dialog.js";
import { count, cut, metres, same, seconds, shown, withUnit } from "./format.js";
import { percent } from "./overview.js";
import { SEVERITIES, SIGNS } from "./severity.js";
import { Steps } from "./steps.js";
import { Level, leastSure } from "./sure.js";
import { html, useState } from "./vendor.js";
import { Add, Value, unknownParameter } from "./values.js";

export const colour = (index) => `t${index % 8}`;

/** The task in one line; opened, everything that can be read and changed. */
export function Task({ store, task, index, last, tab, keys, move, remove, handle, over }) {
  const chosen = store.selected?.task === task.id;
  const open = Boolean(store.opened[task.id]);
  const number = index + 1;
  const label = `task ${number}, ${task.title}`;
  const press = () => {
    if (chosen || !open) store.set({ opened: { ...store.opened, [task.id]: !open } });
    store.select({ task: task.id });
  };
  return html`<li id=${`task-${task.id}`} class=${`task ${colour(index)} ${chosen ? "chosen" : ""} ${open ? "open" : ""} ${over}`}>
    <div class="top"><span class="handle" title="Drag to another place in the order" aria-hidden="true" ...${handle}>⠿</span>
      <button class="head" tabindex=${tab} aria-expanded=${open} aria-current=${chosen ? "true" : null} onClick=${press} onKeyDown=${(event) => keys(event, task, index)}>
        <${Line} store=${store} task=${task} number=${number} row=${store.plan.brief.rows[index]} /></button></div>
    ${open && html`<${Details} store=${store} task=${task} index=${index} last=${last} label=${label} move=${move} remove=${remove} />`}
  </li>`;
}

function Line({ store, task, number, row }) {
  const least = (known, nothing, text) => (known ? text : nothing ? "?" : `≥ ${text}`);
  return html`<span class="number">${number}</span>
    <span class="what"><span class="title">${task.title}</span> <bdi class="gist">${gist(store, task)}</bdi></span>
    <span class="marks"><${Flags} store=${store} task=${task} /></span>
    <span class="way"><span class="unseen">, way </span>${least(row.known, !row.length, metres(row.length))}</span>
    <span class="time"><span class="unseen">, time </span>${least(row.known, !row.seconds, seconds(row.seconds < 600 ? row.seconds : 60 * Math.round(row.seconds / 60)))}</span>
    <span class="used"><span class="unseen">, endurance used at its end </span>${row.used === null ? "" : percent(row.used)}</span>`;
}

/** Warnings of a task by severity, and how sure the agents were of it. */
function Flags({ store, task }) {
  const own = store.warnings.filter((warning) => warning.task === task.id);
  const level = leastSure(task);
  return html`${SEVERITIES.map(([severity, one]) => {
    const n = own.filter((warning) => warning.severity === severity).length;
    return n > 0 && html` <span key=${severity} class=${`flag ${severity}`} title=${count(n, one)}>${SIGNS[severity]}<span class="unseen"> ${count(n, one)}</span></span>`;
  })}<${Level} of=${level} />`;
}

/** The values of a task in a few words: a place by its name. */
function gist(store, task) {
  const known = store.plan.vocabulary.tasks.find((one) => one.title === task.title)?.parameters || [];
  return Object.entries(task.parameters).map(([name, value]) => {
    if (task.located?.[name]) return cut(task.located[name]);
    if (same(value, store.plan.vocabulary.unresolved)) return task.waits_for ? `place not known: ${cut(task.waits_for)}` : "place not known";
    if (same(value, store.plan.vocabulary.home)) return "home";
    const { unit } = known.find((one) => one.name === name) || {};
    return unit === "s" ? seconds(value) : cut(withUnit(value, unit));
  }).join(" · ");
}

function Details({ store, task, index, last, label, move, remove }) {
  const { vocabulary, busy, planner } = store.plan;
  const kind = vocabulary.tasks.find((one) => one.title === task.title);
  const [open, unfold] = useState((task.skill_sequence || []).length <= 4);
  const steps = task.skill_sequence;
  return html`<div class="details">
    <p class="soft">${kind ? `${kind.description} (${kind.category})` : "not in the definition"} <span class="id">· ${task.id} in the file</span></p>
    <dl class="parameters">${Object.entries(task.parameters).map(([name, value]) => html`<${Parameter} key=${name} store=${store} task=${task} name=${name} value=${value}
      label=${label} known=${kind?.parameters.find((one) => one.name === name) || unknownParameter(name, value)} />`)}
      <${Add} store=${store} label=${label} known=${kind?.parameters || []} given=${task.parameters} change=${(name, value) => store.edit({ kind: "parameter", task: task.id, name, value }, `${label}, ${name}`)} /></dl>
    <${Prompt} store=${store} task=${task} label=${label} />
    ${task.problems && html`<p class="refusal">The Task Agent's answer is not valid: ${task.problems.join("; ")}</p>`}
    ${(task.assumptions || []).map((text) => html`<p class="soft" key=${text}>${text}</p>`)}
    ${task.waits_for && html`<p class="waits">Waits for the place of <bdi>${task.waits_for}</bdi>; its steps are planned once it is known.</p>`}
    ${task.asks && html`<p class="waits">Waits for ${task.asks.join(" and ")}: add it above, then plan its steps.</p>`}
    ${task.stale && html`<p class="waits">The steps were planned before this task was changed.</p>`}
    <div class="under">
      ${steps && html`<button class="plain fold" aria-expanded=${open} onClick=${() => unfold(!open)}>${open ? "▾" : "▸"} ${count(steps.length, "step")}${open ? "" : `: ${summary(steps)}`}</button>`}
      <button class=${task.stale || (!steps && !task.waits_for && !task.asks) ? "act" : "plain"} disabled=${!planner.available || Boolean(busy) || Boolean(task.waits_for || task.asks)} title=${planner.available ? "Asks the Task Agent for this task alone" : planner.why}
        onClick=${() => store.skillsAgain(task.id, label)}>${steps ? "Plan its steps again" : "Plan its steps"}</button>
    </div>
    ${steps && open && html`<${Steps} store=${store} task=${task} number=${index + 1} />`}
    <div class="tools">
      <button aria-label=${`Earlier: ${label}`} title="Alt+↑" disabled=${index === 0} onClick=${() => move(task, index, index - 1)}>↑ Earlier</button>
      <button aria-label=${`Later: ${label}`} title="Alt+↓" disabled=${last} onClick=${() => move(task, index, index + 1)}>↓ Later</button>
      <button aria-label=${`Remove ${label}`} title="Delete; undo brings it back" onClick=${() => remove(task, index)}>✕ Remove</button>
    </div>
  </div>`;
}

function summary(steps) {
  const counts = {};
  for (const step of steps) counts[step.navigation_skill.name] = (counts[step.navigation_skill.name] || 0) + 1;
  return Object.entries(counts).map(([name, n]) => (n > 1 ? `${name} × ${n}` : name)).join(", ");
}

const KINDS = { command: "command", located: "place", derived: "rule", vehicle: "vehicle's own", operator: "changed", model: "model's own" };

/** Where a value is from: words of the command, a place, a rule, the vehicle, the model, or who changed it and from what. */
function Source({ store, task, name, source, known }) {
  const letters = [...store.plan.document.command];
  const words = (source.spans || []).map(([start, end]) => `“${letters.slice(start, end).join("")}”`).join(" ");
  if (source.kind === "operator") {
    const change = store.plan.differences.find((one) => one.task === task.id && (one.name === name || one.kind === "added"));
    const was = change?.kind === "parameter" && change.before !== null ? `the model proposed ${withUnit(change.before, known.unit)}` : "the model proposed nothing here";
    return html`<span class="source of-operator">changed by <bdi>${change?.by || "somebody without a name"}</bdi>; ${was}</span>`;
  }
  if (source.kind === "located" && source.note) return html`<span class="source of-located">${source.note.replace("resolved location", "place of")}</span>`;
  return html`<span class=${`source of-${source.kind}`} title=${source.note || ""}>${KINDS[source.kind] || source.kind}${words && html` <q>${words}</q>`}${!words && source.note ? `: ${source.note.replace("unresolved location: ", "")}` : ""}</span>`;
}

function Parameter({ store, task, name, value, known, label }) {
  const source = task.sources?.[name];
  const spans = source?.spans || [];
  const chosen = store.selected?.task === task.id && store.selected.parameter === name;
  const light = () => store.light(spans);
  const dark = () => store.light([]);
  const change = (next) => store.edit({ kind: "parameter", task: task.id, name, value: next }, `${label}, ${name} ${next === null ? "left out" : shown(next)}`);
  return html`<div class=${`parameter ${chosen ? "chosen" : ""}`} data-parameter=${name} onMouseEnter=${light} onMouseLeave=${dark} onfocusin=${light} onfocusout=${dark}>
    <dt>${name}</dt>
    <dd><${Level} of=${task.confidence?.values?.[name]} /><${Value} store=${store} label=${label} parameter=${known} value=${value} change=${change} />
      ${source && html`<${Source} store=${store} task=${task} name=${name} source=${source} known=${known} />`}</dd>
  </div>`;
}

function Prompt({ store, task, label }) {
  const [text, write] = useState(null);
  const [refused, refuse] = useState(null);
  const save = async (event) => {
    event.preventDefault();
    const sentence = await store.edit({ kind: "prompt", task: task.id, text }, `${label}, prompt`);
    if (sentence) refuse(sentence);
    else write(null);
  };
  if (text === null) return html`<p class="prompt"><span dir="auto">${task.task_prompt}</span> <button class="plain" aria-label=${`Change what the Task Agent is told of ${label}`} onClick=${() => { refuse(null); write(task.task_prompt); }}>Change</button></p>`;
  return html`<form class="edit prompt" onSubmit=${save}>
    <label>What the Task Agent is told<textarea rows="3" value=${text} onInput=${(event) => write(event.target.value)} onKeyDown=${(event) => event.key === "Escape" && write(null)}></textarea></label>
    <button class="act">Save</button> <button type="button" class="plain" onClick=${() => write(null)}>Cancel</button>
    <${Refusal} text=${refused} /></form>`;
}
