// The plan in short before it is approved: what happens, what was waved through, what it rests on, and who changed what.

import { metres, number, seconds, shown } from "./format.js";
import { title, value } from "./changes.js";
import { percent } from "./overview.js";
import { SEVERITIES, of } from "./severity.js";
import { html } from "./vendor.js";

export function Summary({ store }) {
  const { document, brief, differences } = store.plan;
  const { estimate, vehicle } = document;
  const least = estimate.open.length ? "at least " : "";
  const used = vehicle?.endurance ? `, ${least}${percent(estimate.seconds / vehicle.endurance)} of the endurance` : "";
  return html`<div class="summary" autofocus tabindex="0" role="region" aria-label="Summary of the plan">
    <p><b>${least}${metres(estimate.length)}, ${least}${seconds(estimate.seconds)}${used}. Ends ${brief.end}.</b></p>
    <ol>${document.tasks.map((task, index) => html`<li key=${task.id}>${task.title}: ${Object.entries(task.parameters).map(([name, it]) => `${name} ${shown(it)}`).join(", ") || "no values"}
      <small> ${metres(brief.rows[index].length)}, ${seconds(brief.rows[index].seconds)}${task.skill_sequence ? "" : ", no steps"}</small></li>`)}</ol>
    ${SEVERITIES.map(([severity, one]) => html`<${List} key=${severity} className=${severity} title=${`${one[0].toUpperCase()}${one.slice(1)}s that you acknowledged`} texts=${of(store, severity).map((warning) => `${warning.name}. ${warning.text}`)} />`)}
    <${List} title="Taken for granted" texts=${brief.assumed} />
    <${List} title="Not checked by any program" texts=${brief.unchecked} />
    <${List} title="Changed since the model proposed it" texts=${differences.map((one) => `${title(one, store)}: ${value(one.kind, one.before)} became ${value(one.kind, one.after)}${one.by ? `, by ${one.by}` : ""}`)} />
  </div>`;
}

const List = ({ title: heading, texts, className = "" }) => texts.length > 0 && html`<h3 class=${className}>${heading} (${number(texts.length)})</h3><ul class=${className}>${texts.map((text) => html`<li key=${text}><bdi>${text}</bdi></li>`)}</ul>`;
