// Approve, then export; or reject. The button says what is still lacking, and leads there; a plan that was changed outside of the review has none.

import { Dialog, Refusal } from "./dialog.js";
import { Export } from "./export.js";
import { count, when } from "./format.js";
import { Summary } from "./summary.js";
import { html, useEffect, useLayoutEffect, useRef, useState } from "./vendor.js";

function lacking(store) {
  const open = store.warnings.filter((warning) => !store.isAcknowledged(warning)).length;
  const found = [];
  if (open) found.push([count(open, "warning"), "#warnings input:not(:checked)"]);
  if (!store.reviewer.trim()) found.push(["your name", "#reviewer"]);
  return found;
}

export function Decision({ store }) {
  const [dialog, show] = useState(null);
  const { plan } = store;
  const approved = plan.approval.status === "approved";
  const lack = lacking(store);
  const approve = (event) => {
    event.preventDefault();
    if (approved) return show("export");
    if (lack.length) return window.document.querySelector(lack[0][1])?.focus();
    return show("summary");
  };
  const close = () => show(null);
  return html`<form class=${`decision ${approved ? "approved" : ""}`} id="decision" aria-label="Decision" onSubmit=${approve}>
    <p class="standing">${standing(plan)}</p>
    ${!approved && html`<label class="name" for="reviewer"><span>Your name</span><input id="reviewer" autocomplete="name" maxlength="200" value=${store.reviewer} onInput=${(event) => store.rename(event.target.value)} /></label>`}
    <button type="button" class="refuse" onClick=${() => show("reject")}>Reject …</button>
    ${approved ? plan.formats.length > 0 && html`<button class="act export">Export …</button>`
      : !plan.tampered && html`<button class="act approve" aria-disabled=${lack.length > 0}>${lack.length ? `Approve: ${lack.map(([what]) => what).join(" and ")} lacking` : "Approve …"}</button>`}
  </form>
  ${dialog === "summary" && html`<${Approve} store=${store} close=${close} />`}
  ${dialog === "export" && html`<${Export} store=${store} close=${close} />`}
  ${dialog === "reject" && html`<${Reject} store=${store} close=${close} />`}`;
}

function standing({ approval, document, tampered }) {
  if (tampered) return html`<b class="bad">This plan was changed outside of the review and cannot be approved.</b>`;
  if (approval.status === "approved") return html`<b>Approved by <bdi>${approval.reviewer}</bdi>, ${when(approval.time)}, record ${approval.sequence}.</b> Next: export it for the vehicle.`;
  return html`<b>Nothing moves before this plan is approved.</b> ${count(document.tasks.length, "task")}, ${document.complete ? "all with steps" : "not complete"}.`;
}

/** What is approved, once more and in short; the focus is on the text, so that a second Enter approves nothing. */
function Approve({ store, close }) {
  const [refused, refuse] = useState(null);
  const [sending, send] = useState(false);
  const revision = useRef(store.plan.revision).current;
  useEffect(() => {
    if (store.plan.revision !== revision) close();
  }, [store.plan.revision]);
  const approve = async () => {
    send(true);
    const sentence = await store.approve();
    send(false);
    if (sentence) return refuse(sentence);
    close();
    return setTimeout(() => window.document.querySelector(".decision .export")?.focus());
  };
  return html`<${Dialog} title="Approve this plan?" close=${close} wide>
    <${Summary} store=${store} />
    <${Refusal} text=${refused} />
    <p class="buttons"><button onClick=${close}>Back</button><button class="act" disabled=${sending} onClick=${approve}>Approve as ${store.reviewer.trim()}</button></p>
  <//>`;
}

function Reject({ store, close }) {
  const [reason, write] = useState("");
  const [refused, refuse] = useState(null);
  const field = useRef();
  useLayoutEffect(() => field.current.focus(), []);
  const send = async (event) => {
    event.preventDefault();
    const name = store.reviewer.trim();
    const lack = !reason.trim() ? "your reason" : !name ? "your name" : null;
    const sentence = lack ? `A rejection needs ${lack}.` : await store.reject(name, reason.trim());
    if (sentence) refuse(sentence);
    else close();
  };
  return html`<${Dialog} title="Reject this plan" close=${close}>
    <form class="form" onSubmit=${send}>
      <label>Reason, for the log<textarea ref=${field} rows="3" value=${reason} onInput=${(event) => write(event.target.value)} aria-describedby="reject-refused"></textarea></label>
      <label>Your name<input value=${store.reviewer} onInput=${(event) => store.rename(event.target.value)} /></label>
      <${Refusal} id="reject-refused" text=${refused} />
      <p class="buttons"><button type="button" onClick=${close}>Back</button><button class="refuse">Reject the plan</button></p>
    </form>
  <//>`;
}

/** Asks once whose changes these are. */
export function Naming({ store }) {
  const { take } = store.naming;
  const [name, write] = useState("");
  const field = useRef();
  useLayoutEffect(() => field.current.focus(), []);
  const send = (event) => {
    event.preventDefault();
    take(name.trim() || null);
  };
  return html`<${Dialog} title="Who changes this plan?" close=${() => take(null)}>
    <form class="form" onSubmit=${send}>
      <label>Your name stands beside every change of yours<input ref=${field} autocomplete="name" maxlength="200" value=${name} onInput=${(event) => write(event.target.value)} /></label>
      <p class="buttons"><button type="button" onClick=${() => take(null)}>Change nothing</button><button class="act" disabled=${!name.trim()}>Go on</button></p>
    </form>
  <//>`;
}
