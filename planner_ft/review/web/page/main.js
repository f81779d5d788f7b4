// The page: header, the panels of a plan, the decision below them, and the dialogs.

import { Chart } from "./chart.js";
import { Command } from "./command.js";
import { NewCommand, Progress } from "./compose.js";
import { Decision, Naming } from "./decision.js";
import { Changes } from "./changes.js";
import { Facts, Provenance } from "./facts.js";
import { Header, Messages } from "./header.js";
import { Help, shortcut } from "./help.js";
import { Run } from "./run.js";
import { Store } from "./store.js";
import { Tasks } from "./tasks.js";
import { html, render, useEffect, useReducer, useState } from "./vendor.js";
import { Warnings } from "./warnings.js";

const PARTS = [["overview", "Tasks"], ["warnings", "Warnings"], ["chart-title", "Chart"], ["command-title", "Command"], ["decision", "Decision"]];

function Page() {
  const [, draw] = useReducer((n) => n + 1, 0);
  const [store] = useState(() => new Store(draw));
  const [dialog, show] = useState(null);
  useEffect(() => store.start(), [store]);
  useEffect(() => {
    const press = (event) => shortcut(event, store, show);
    document.addEventListener("keydown", press);
    return () => document.removeEventListener("keydown", press);
  }, [store]);
  const plan = store.plan;
  if (!plan) return html`<p class="loading" role="status">${store.alert || "The plan is being read."}</p>`;
  const document_ = plan.document;
  return html`
    <a class="skip" href="#overview">Skip to the tasks</a><a class="skip" href="#warnings">Skip to the warnings</a>
    <${Header} store=${store} show=${show} />
    <${Messages} store=${store} />
    ${plan.busy && plan.busy.what === "planning" && html`<${Progress} store=${store} />`}
    ${document_
      ? html`<nav class="jump" aria-label="Parts of the page">${PARTS.map(([goal, name]) => html`<a key=${goal} href=${`#${goal}`}>${name}</a>`)}</nav>
          <main class="plan">
            <${Tasks} key=${`tasks ${plan.path}`} store=${store} show=${show} />
            <div class="column told" key=${plan.path}>
              <${Run} store=${store} />
              <${Warnings} store=${store} />
              <${Facts} store=${store} />
              <${Command} store=${store} />
              <${Changes} store=${store} />
              <${Provenance} store=${store} />
            </div>
            <${Chart} key=${`chart ${plan.path}`} store=${store} />
          </main>
          <${Decision} key=${`decision ${plan.path}`} store=${store} />`
      : !plan.busy && html`<main class="empty"><h2>No plan is open</h2>
          <p>${plan.planner.available ? "Give a command, and the two agents propose a plan." : plan.planner.why}</p>
          <button class="act" disabled=${!plan.planner.available} onClick=${() => show("command")}>New command</button></main>`}
    ${dialog === "command" && html`<${NewCommand} store=${store} close=${() => show(null)} />`}
    ${store.naming && html`<${Naming} store=${store} />`}
    ${dialog === "help" && html`<${Help} close=${() => show(null)} />`}
  `;
}

const root = document.getElementById("page");
root.replaceChildren();
render(html`<${Page} />`, root);
