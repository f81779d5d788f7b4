// Approve or reject. The button says what is still lacking, and leads there.

import { Dialog, Refusal } from "./dialog.js";
import { count, when } from "./format.js";
import { html, useEffect, useLayoutEffect, useRef, useState } from "./vendor.js";

function lacking(store, name) {
  const open = store.warnings.filter((warning) => !store.isAcknowledged(warning)).length;
  const found = [];
  if (open) found.push([count(open, "warning"), "#warnings input:not(:checked)"]);
  if (!name.trim()) found.push(["your name", "#reviewer"]);
  return found;
}

export function Decision({ store }) {
  const [name, setName] = useState(sessionStorage.getItem("reviewer") || "");
  const [refused, refuse] = useState(null);
  const [rejecting, setRejecting] = useState(false);
  const [sending, send] = useState(false);
  const { plan } = store;
  useEffect(() => refuse(null), [plan.revision, plan.approval.status]);
  const lack = lacking(store, name);
  const write = (event) => {
    setName(event.target.value);
    sessionStorage.setItem("reviewer", event.target.value);
  };
  const approve = async (event) => {
    event.preventDefault();
    if (lack.length) return window.document.querySelector(lack[0][1])?.focus();
    send(true);
    refuse(await store.approve(name.trim()));
    return send(false);
  };
  const approved = plan.approval.status === "approved";
  const label = lack.length ? `Approve: ${lack.map(([what]) => what).join(" and ")} lacking` : approved ? "Approve again" : "Approve this plan";
  return html`<form class="decision" id="decision" aria-label="Decision" onSubmit=${approve}>
    <p class="standing"><b>${approved ? `Approved by ${plan.approval.reviewer}, ${when(plan.approval.time)}, record ${plan.approval.sequence}.` : "Nothing moves before this plan is approved."}</b>
      ${" "}${count(plan.document.tasks.length, "task")}, ${plan.document.complete ? "all with steps" : "not complete"}.</p>
    <${Refusal} id="decision-refused" text=${refused} />
    <label class="name" for="reviewer"><span>Your name</span><input id="reviewer" autocomplete="name" maxlength="200" value=${name} onInput=${write} aria-describedby="decision-refused" /></label>
    <button type="button" class="refuse" onClick=${() => setRejecting(true)}>Reject …</button>
    <button class="act approve" aria-disabled=${lack.length > 0} disabled=${sending}>${label}</button>
  </form>
  ${rejecting && html`<${Reject} store=${store} name=${name} setName=${write} close=${() => setRejecting(false)} />`}`;
}

function Reject({ store, name, setName, close }) {
  const [reason, write] = useState("");
  const [refused, refuse] = useState(null);
  const field = useRef();
  useLayoutEffect(() => field.current.focus(), []);
  const send = async (event) => {
    event.preventDefault();
    const lack = !reason.trim() ? "your reason" : !name.trim() ? "your name" : null;
    const sentence = lack ? `A rejection needs ${lack}.` : await store.reject(name.trim(), reason.trim());
    if (sentence) refuse(sentence);
    else close();
  };
  return html`<${Dialog} title="Reject this plan" close=${close}>
    <form class="form" onSubmit=${send}>
      <label>Reason, for the log<textarea ref=${field} rows="3" value=${reason} onInput=${(event) => write(event.target.value)} aria-describedby="reject-refused"></textarea></label>
      <label>Your name<input value=${name} onInput=${setName} /></label>
      <${Refusal} id="reject-refused" text=${refused} />
      <p class="buttons"><button type="button" onClick=${close}>Back</button><button class="refuse">Reject the plan</button></p>
    </form>
  <//>`;
}
