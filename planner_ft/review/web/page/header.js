// The bar on top: which plan, whether it is approved, theme; and the messages below it.

import { cut, when } from "./format.js";
import { html, useState } from "./vendor.js";

const THEMES = [["system", "As the system"], ["light", "Light"], ["sunlight", "Sunlight"], ["night", "Night"]];
const APPROVALS = { approved: "good", rejected: "bad", altered: "open", unknown: "open" };
const NAMES = { approved: "Approved", rejected: "Rejected", altered: "Changed since", unknown: "Not approved yet" };

export function Header({ store, show }) {
  const { plan } = store;
  return html`<header class="bar">
    <h1>Plan review</h1>
    <span class="vehicle">${plan.document?.vehicle?.name || plan.vocabulary.name}</span>
    <label class="picker"><span>Plan</span>
      <select value=${plan.path || ""} disabled=${Boolean(plan.busy) || plan.plans.length === 0} onChange=${(event) => store.open(event.target.value)}>
        ${!plan.path && html`<option value="">none</option>`}
        ${plan.plans.map((path) => html`<option key=${path} value=${path}>${path}</option>`)}
      </select></label>
    ${plan.document && (plan.tampered ? html`<span class="state bad"><b>Changed outside</b></span>` : html`<${Approval} approval=${plan.approval} />`)}
    <span class="space"></span>
    <span class="saving" role="status">${store.changing > 0 ? "Saving …" : ""}</span>
    ${!store.connected && html`<span class="state bad" role="status">No connection, trying again</span>`}
    <button onClick=${() => show("command")}>New command</button>
    <${Theme} />
    <button aria-label="Keys and help" title="Keys and help (?)" onClick=${() => show("help")}>?</button>
  </header>`;
}

/** A plan whose content is not that of its digest: what differs, and the way out. */
function Tampered({ plan }) {
  const shown = plan.tampered.slice(0, 12);
  return html`<div class="message bad tampered"><div><p><b>This plan was changed outside of the review</b> since it was saved, by hand or by another program. It can be read, but not changed or approved.</p>
    ${shown.length > 0 && html`<p>What differs:</p><ul>${shown.map((text) => html`<li key=${text}><bdi>${text}</bdi></li>`)}${plan.tampered.length > shown.length && html`<li>and ${plan.tampered.length - shown.length} more</li>`}</ul>`}
    <p>Put the file back from a copy, or take the changes over in the terminal: <code>plannerft review ${plan.path} --adopt</code></p></div></div>`;
}

function Approval({ approval }) {
  const by = approval.reviewer && html`by <bdi>${cut(approval.reviewer)}</bdi>`;
  return html`<span class=${`state ${APPROVALS[approval.status] || "open"}`} title=${[approval.text, when(approval.time), approval.sequence && `record ${approval.sequence}`].filter(Boolean).join("; ")}><b>${NAMES[approval.status] || approval.status}</b>${by && html` <span class="by">${by}</span>`}</span>`;
}

function Theme() {
  const [theme, set] = useState(document.documentElement.dataset.theme);
  const choose = (event) => {
    document.documentElement.dataset.theme = event.target.value;
    set(event.target.value);
    try {
      localStorage.setItem("theme", event.target.value);
    } catch {
      // Storage is switched off: the choice holds until the page is closed.
    }
  };
  return html`<label class="picker"><span>Theme</span>
    <select value=${theme} onChange=${choose}>${THEMES.map(([value, name]) => html`<option value=${value}>${name}</option>`)}</select></label>`;
}

/** Conflict, failure, and the last thing that happened; each is announced. */
export function Messages({ store }) {
  const { conflict, alert, plan } = store;
  return html`<div class="messages">
    <div role="alert">
      ${conflict && html`<div class="message bad">
        <p><b>Somebody else changed this plan.</b> ${conflict.error} It is shown as it is now; your change “${conflict.label}” was not made.</p>
        ${conflict.repeat && html`<button onClick=${() => store.repeat(conflict)}>Make my change on the new plan</button>`}
        <button onClick=${() => store.set({ conflict: null })}>${conflict.repeat ? "Drop my change" : "Understood"}</button>
      </div>`}
      ${alert && html`<div class="message bad"><p>${alert}</p><button onClick=${() => store.set({ alert: null })}>Dismiss</button></div>`}
      ${plan.tampered && html`<${Tampered} plan=${plan} />`}
      ${plan.document && !plan.tampered && plan.approval.status === "altered" && html`<div class="message warn"><p>${plan.approval.text}. It needs a new approval.</p></div>`}
      ${plan.document && plan.approval.status === "unknown" && !plan.approval.text.startsWith("not approved") && html`<div class="message bad"><p>${plan.approval.text}</p></div>`}
    </div>
    ${plan.busy && plan.busy.what !== "planning" && html`<div class="message"><p>${plan.busy.label}</p></div>`}
    <p class="unseen" role="status" aria-live="polite">${store.notice}</p>
  </div>`;
}
