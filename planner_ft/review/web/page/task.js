// One task: title, parameters with where each comes from, prompt, steps, and what can be done to it.

import { Refusal } from "./dialog.js";
import { count, metres, same, seconds, shown, withUnit } from "./format.js";
import { Steps } from "./steps.js";
import { Level, leastSure } from "./sure.js";
import { html, useState } from "./vendor.js";
import { Add, Value, unknownParameter } from "./values.js";

export const colour = (index) => `t${index % 8}`;

export function Task({ store, task, index, last, tab, keys, move, remove, open, toggle, handle, over }) {
  const { vocabulary, track, busy, planner } = store.plan;
  const kind = vocabulary.tasks.find((one) => one.title === task.title);
  const chosen = store.selected?.task === task.id;
  const number = index + 1;
  const label = `task ${number}, ${task.title}`;
  const legs = track?.legs.filter((leg) => leg.task === task.id) || [];
  const way = legs.reduce((sum, leg) => sum + leg.metres, 0);
  const time = legs.reduce((sum, leg) => sum + leg.seconds, 0);
  const steps = task.skill_sequence;
  const warnings = store.warnings.filter((warning) => warning.task === task.id);
  return html`<li id=${`task-${task.id}`} class=${`task ${colour(index)} ${chosen ? "chosen" : ""} ${over}`}>
    <div class="top">
      <span class="handle" title="Drag to another place in the order" aria-hidden="true" ...${handle}>⠿</span>
      <button class="head" tabindex=${tab} aria-expanded=${open} aria-current=${chosen ? "true" : null} onClick=${() => (chosen || !open ? toggle() : null) || store.select({ task: task.id })} onKeyDown=${(event) => keys(event, task, index)}>
        <span class="number">${number}</span> <span class="title">${task.title}</span> <span class="id" title="The name of this task in warnings and in the file">${task.id}</span> <span class="category">${[kind?.category || "not in the definition", way > 0 && metres(way), time > 0 && seconds(time)].filter(Boolean).join(" · ")}</span>
        <${Level} of=${leastSure(task)} />${warnings.length > 0 && html` <span class="flag">${count(warnings.length, "warning")}</span>`}
      </button>
      <span class="tools">
        <button aria-label=${`Earlier: ${label}`} title="Earlier (Alt+↑)" disabled=${index === 0} onClick=${() => move(task, index, index - 1)}>↑</button>
        <button aria-label=${`Later: ${label}`} title="Later (Alt+↓)" disabled=${last} onClick=${() => move(task, index, index + 1)}>↓</button>
        <button aria-label=${`Remove ${label}`} title="Remove (Delete); undo brings it back" onClick=${() => remove(task, index)}>✕</button>
      </span>
    </div>
    <dl class="parameters">${Object.entries(task.parameters).map(([name, value]) => html`<${Parameter} key=${name} store=${store} task=${task} name=${name} value=${value}
      label=${label} known=${kind?.parameters.find((one) => one.name === name) || unknownParameter(name, value)} />`)}
      <${Add} store=${store} label=${label} known=${kind?.parameters || []} given=${task.parameters} change=${(name, value) => store.edit({ kind: "parameter", task: task.id, name, value }, `${label}, ${name}`)} /></dl>
    <${Prompt} store=${store} task=${task} label=${label} />
    ${task.problems && html`<p class="refusal">The Task Agent's answer is not valid: ${task.problems.join("; ")}</p>`}
    ${(task.assumptions || []).map((text) => html`<p class="soft" key=${text}>${text}</p>`)}
    ${task.waits_for && html`<p class="waits">Waits for the place of ${task.waits_for}; its steps are planned once it is placed.</p>`}
    ${task.asks && html`<p class="waits">Waits for ${task.asks.join(" and ")}: add it above, then plan its steps.</p>`}
    ${task.stale && html`<p class="waits">The steps were planned before this task was changed.</p>`}
    <div class="under">
      ${steps && html`<button class="plain fold" aria-expanded=${open} onClick=${toggle}>${open ? "▾" : "▸"} ${count(steps.length, "step")}${open ? "" : `: ${summary(steps)}`}</button>`}
      <button class=${task.stale || (!steps && !task.waits_for && !task.asks) ? "act" : "plain"} disabled=${!planner.available || Boolean(busy) || Boolean(task.waits_for || task.asks)} title=${planner.available ? "Asks the Task Agent for this task alone" : planner.why}
        onClick=${() => store.skillsAgain(task.id, label)}>${steps ? "Plan its steps again" : "Plan its steps"}</button>
    </div>
    ${steps && open && html`<${Steps} store=${store} task=${task} number=${number} />`}
  </li>`;
}

function summary(steps) {
  const counts = {};
  for (const step of steps) counts[step.navigation_skill.name] = (counts[step.navigation_skill.name] || 0) + 1;
  return Object.entries(counts).map(([name, n]) => (n > 1 ? `${name} × ${n}` : name)).join(", ");
}

const KINDS = { command: "command", located: "located", derived: "rule", vehicle: "vehicle's", operator: "operator", model: "model's own" };

function Parameter({ store, task, name, value, known, label }) {
  const source = task.sources?.[name];
  const spans = source?.spans || [];
  const proposed = store.plan.document.proposed.tasks.find((one) => one.id === task.id)?.parameters[name];
  const changed = source?.kind === "operator" && proposed !== undefined && !same(proposed, value);
  const chosen = store.selected?.task === task.id && store.selected.parameter === name;
  const light = () => store.light(spans);
  const dark = () => store.light([]);
  const letters = [...store.plan.document.command];
  const words = spans.map(([start, end]) => `“${letters.slice(start, end).join("")}”`).join(" ");
  const change = (next) => store.edit({ kind: "parameter", task: task.id, name, value: next }, `${label}, ${name} ${next === null ? "left out" : shown(next)}`);
  return html`<div class=${`parameter ${chosen ? "chosen" : ""}`} data-parameter=${name} onMouseEnter=${light} onMouseLeave=${dark} onfocusin=${light} onfocusout=${dark}>
    <dt>${name}</dt>
    <dd><${Level} of=${task.confidence?.values?.[name]} /><${Value} store=${store} label=${label} parameter=${known} value=${value} change=${change} />
      ${source && html`<span class=${`source ${source.kind}`} title=${source.note || ""}>${source.kind === "located" && source.note ? source.note : html`${KINDS[source.kind] || source.kind}${words && html` <q>${words}</q>`}${!words && source.note && !changed ? `: ${source.note}` : ""}`}
        ${changed && html` <span class="was">proposed ${withUnit(proposed, known.unit)}</span>`}</span>`}</dd>
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
  if (text === null) return html`<p class="prompt"><span>${task.task_prompt}</span> <button class="plain" aria-label=${`Change the prompt of ${label}`} onClick=${() => { refuse(null); write(task.task_prompt); }}>Change</button></p>`;
  return html`<form class="edit prompt" onSubmit=${save}>
    <label>What the Task Agent is told<textarea rows="3" value=${text} onInput=${(event) => write(event.target.value)} onKeyDown=${(event) => event.key === "Escape" && write(null)}></textarea></label>
    <button class="act">Save</button> <button type="button" class="plain" onClick=${() => write(null)}>Cancel</button>
    <${Refusal} text=${refused} /></form>`;
}
