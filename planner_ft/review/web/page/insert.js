// A task of the operator's own: which, where in the order, its parameters and what the Task Agent is told.

import { Dialog, Refusal } from "./dialog.js";
import { html, useState } from "./vendor.js";
import { Field, hint, parse } from "./values.js";

export function Insert({ store, at, close }) {
  const { vocabulary, document } = store.plan;
  const [title, choose] = useState(vocabulary.tasks[0].title);
  const [place, setPlace] = useState(at);
  const [texts, setTexts] = useState({});
  const [prompt, write] = useState("");
  const [refused, refuse] = useState(null);
  const kind = vocabulary.tasks.find((task) => task.title === title);
  const categories = [...new Set(vocabulary.tasks.map((task) => task.category))];
  const send = async (event) => {
    event.preventDefault();
    const given = kind.parameters.filter((parameter) => (texts[parameter.name] || "").trim());
    const parameters = Object.fromEntries(given.map((parameter) => [parameter.name, parse(parameter.type, texts[parameter.name])]));
    const sentence = await store.edit({ kind: "insert", at: Number(place), title, parameters, task_prompt: prompt }, `${title} inserted as task ${Number(place) + 1}`);
    if (sentence) refuse(sentence);
    else close();
  };
  return html`<${Dialog} title="Insert a task" close=${close} wide>
    <form class="form" onSubmit=${send}>
      <label>Task<select value=${title} onChange=${(event) => choose(event.target.value)}>${categories.map((category) => html`<optgroup key=${category} label=${category}>
        ${vocabulary.tasks.filter((task) => task.category === category).map((task) => html`<option key=${task.title} value=${task.title}>${task.title}</option>`)}</optgroup>`)}</select></label>
      <p class="soft">${kind.description}</p>
      <label>Before which task<select value=${place} onChange=${(event) => setPlace(event.target.value)}>
        ${document.tasks.map((task, index) => html`<option key=${task.id} value=${index}>${index + 1}, before ${task.title}</option>`)}
        <option value=${document.tasks.length}>${document.tasks.length + 1}, at the end</option></select></label>
      ${kind.parameters.map((parameter) => html`<div key=${`${title} ${parameter.name}`} class="field"><label for=${`new-${parameter.name}`}>${parameter.name}${parameter.required ? ", needed" : ""}</label>
        <${Field} id=${`new-${parameter.name}`} parameter=${parameter} value=${texts[parameter.name] || ""} onInput=${(text) => setTexts({ ...texts, [parameter.name]: text })} describedby=${`new-${parameter.name}-hint`} />
        <small id=${`new-${parameter.name}-hint`}>${hint(parameter)}</small></div>`)}
      <label>What the Task Agent is told<textarea rows="3" value=${prompt} onInput=${(event) => write(event.target.value)}></textarea></label>
      <${Refusal} text=${refused} />
      <p class="buttons"><button type="button" onClick=${close}>Cancel</button><button class="act">Insert</button></p>
    </form>
  <//>`;
}
