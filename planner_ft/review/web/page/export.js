// The approved plan as files for vehicles: what stops the mission stands first, and an origin that is hardly right is asked about.

import { Dialog, Refusal } from "./dialog.js";
import { html, useEffect, useState } from "./vendor.js";

export function Export({ store, close }) {
  const { formats, document } = store.plan;
  const given = document.origin ? `${document.origin.latitude},${document.origin.longitude}` : "";
  const [chosen, choose] = useState([formats[0].name]);
  const [origin, write] = useState(given);
  const [overwrite, replace] = useState(false);
  const [refusal, refuse] = useState(null);
  const [files, show] = useState(null);
  const needs = formats.some((one) => one.needs_origin && chosen.includes(one.name));
  const send = async (event, sure = false) => {
    event.preventDefault();
    const answer = await store.exportAs(chosen, given ? "" : origin, overwrite, sure);
    refuse(answer.error ? answer : null);
    if (answer.files) show(answer.files);
  };
  const toggle = (name) => choose(chosen.includes(name) ? chosen.filter((one) => one !== name) : [...chosen, name]);
  if (files) return html`<${Dialog} title="Exported" close=${close} wide>
    ${files.map((file) => html`<${Written} key=${file.file} file=${file} />`)}
    <p class="buttons"><button onClick=${() => show(null)}>Export another</button><button class="act" onClick=${close}>Done</button></p><//>`;
  return html`<${Dialog} title="Export for the vehicle" close=${close} wide>
    <form class="form" onSubmit=${send}>
      <fieldset><legend>Which files</legend>${formats.map((one) => html`<label key=${one.name} class="check"><input type="checkbox" checked=${chosen.includes(one.name)} onChange=${() => toggle(one.name)} /> <span><b>${one.name}</b> (${one.extension}) <small>${one.description}</small></span></label>`)}</fieldset>
      ${needs && (given ? html`<p>[0, 0] lies at ${given}, as the plan says.</p>` : html`<label>Where [0, 0] lies: latitude, longitude<input value=${origin} placeholder="54.3217,10.1412" inputmode="text" onInput=${(event) => write(event.target.value)} aria-describedby="export-refused" /><small>decimal degrees; south and west are negative</small></label>`)}
      <label class="check"><input type="checkbox" checked=${overwrite} onChange=${() => replace(!overwrite)} /> Replace what was exported of this plan before</label>
      <${Refusal} id="export-refused" text=${refusal && (refusal.question || refusal.error)} />
      <p class="buttons"><button type="button" onClick=${close}>Cancel</button>
        ${refusal?.question && html`<button type="button" class="refuse" onClick=${(event) => send(event, true)}>The origin is right: export</button>`}
        <button class="act" disabled=${!chosen.length || (needs && !given && !origin.trim())}>Export</button></p>
    </form>
  <//>`;
}

function Written({ file }) {
  const [address, offer] = useState(null);
  useEffect(() => {
    const made = URL.createObjectURL(new Blob([file.text], { type: "application/octet-stream" }));
    offer(made);
    return () => URL.revokeObjectURL(made);
  }, [file]);
  return html`<section class="written"><h3>${file.file}</h3>
    ${file.stops.length ? html`<ul class="stops">${file.stops.map((text) => html`<li key=${text}><b>${text[0].toUpperCase()}${text.slice(1)}.</b></li>`)}</ul>` : html`<p>Nothing in this file stops the mission.</p>`}
    <p><a href=${address} download=${file.file}>Download ${file.file}</a> <small>It lies beside the plan, and ${file.report} says what it does not hold.</small></p>
    <details><summary>What the file does not hold, or holds in another form (${file.lines.length})</summary><ul>${file.lines.map((line) => html`<li key=${line}>${line}</li>`)}</ul></details>
  </section>`;
}
