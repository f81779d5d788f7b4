"use strict";
// Fills the sample lists. Texts reach the page as text nodes alone: answers of models are never read as markup.
(() => {
  const STEP = 40;
  const WORDS = { same: "same", changed: "≠ value", moved: "↕ moved", missing: "− missing", extra: "+ extra", substituted: "⇄ instead" };

  const element = (name, attributes = {}, ...children) => {
    const node = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) {
      if (value === false || value === null || value === undefined) continue;
      if (key === "on") for (const [event, handler] of Object.entries(value)) node.addEventListener(event, handler);
      else node.setAttribute(key, value === true ? "" : value);
    }
    node.append(...children.flat().filter((child) => child !== null && child !== undefined));
    return node;
  };

  const unpack = async (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return JSON.parse(await new Response(stream).text());
  };

  class Explorer {
    constructor(root) {
      this.root = root;
      this.number = root.dataset.number;
      this.data = JSON.parse(document.getElementById(`index-${this.number}`).textContent);
      this.parts = new Map();
      this.shown = 0;
      this.found = [];
      this.texts = this.data.samples.map(([id, command, group, family, answers]) =>
        [id, command, group, family, ...answers.flatMap((answer) => (answer ? answer[2].map((name) => this.data.names[name]) : []))].join("\n").toLowerCase());
      this.build();
      this.apply();
      this.follow();
      window.addEventListener("hashchange", () => this.follow());
    }

    build() {
      const { systems, outcomes, samples, title } = this.data;
      const kinds = outcomes.slice(1).sort();
      const groups = [...new Set(samples.map((sample) => sample[2]).filter(Boolean))].sort();
      const change = { on: { change: () => this.apply() } };
      const option = (value, label) => element("option", { value }, label);
      let waiting;
      this.search = element("input", { type: "search", autocomplete: "off", on: { input: () => { clearTimeout(waiting); waiting = setTimeout(() => this.apply(), 120); } } });
      this.system = element("select", change, option("", "all"), systems.map((name, index) => option(index, name)));
      this.outcome = element("select", change, option("", "all"), option("right", "right"), option("wrong", "wrong"),
        systems.length > 1 ? option("split", "right and wrong (systems differ)") : null, kinds.map((kind) => option(`kind ${kind}`, kind)));
      this.group = element("select", change, option("", "all"), groups.map((group) => option(group, group)));
      const field = (label, control) => element("label", {}, label, control);
      const reset = element("button", { type: "button", class: "button", on: { click: () => { this.set(); this.search.focus(); } } }, "Show all");
      this.status = element("p", { class: "status", role: "status" });
      this.list = element("ol", { class: "samples", "aria-label": `Samples: ${title}`, on: { keydown: (event) => this.step(event) } });
      this.more = element("button", { type: "button", class: "button", on: { click: () => this.extend() } });
      this.root.append(
        element("div", { class: "filters", role: "search", "aria-label": `Filter samples: ${title}` }, field("Text in command, id or names of the answer", this.search),
          field("System", this.system), field("Outcome", this.outcome), groups.length ? field("Group", this.group) : null, reset),
        this.status, this.list, this.more);
    }

    set({ system = "", outcome = "", text = "", group = "" } = {}) {
      [this.system.value, this.outcome.value, this.search.value, this.group.value] = [system, outcome, text, group];
      this.apply();
    }

    fits(answers) {
      const wanted = this.outcome.value;
      const chosen = this.system.value === "" ? answers : [answers[this.system.value]];
      const outcomes = chosen.filter(Boolean).map((answer) => answer[0]);
      if (!wanted) return this.system.value === "" || outcomes.length > 0;
      if (wanted === "right") return outcomes.length > 0 && outcomes.every((outcome) => outcome === 0);
      if (wanted === "wrong") return outcomes.some((outcome) => outcome !== 0);
      if (wanted === "split") return outcomes.some((outcome) => outcome === 0) && outcomes.some((outcome) => outcome !== 0);
      return outcomes.some((outcome) => `kind ${this.data.outcomes[outcome]}` === wanted);
    }

    apply() {
      const words = this.search.value.toLowerCase().split(/\s+/).filter(Boolean);
      const group = this.group.value;
      this.found = [];
      this.data.samples.forEach((sample, index) => {
        if ((!group || sample[2] === group) && words.every((word) => this.texts[index].includes(word)) && this.fits(sample[4])) this.found.push(index);
      });
      this.shown = 0;
      this.list.replaceChildren();
      this.extend(false);
      this.status.textContent = `${this.found.length} of ${this.data.samples.length} samples`;
    }

    extend(focus = true) {
      const next = this.found.slice(this.shown, this.shown + STEP).map((index) => this.row(index));
      this.list.append(...next);
      this.shown += next.length;
      const rest = this.found.length - this.shown;
      this.more.hidden = rest <= 0;
      this.more.textContent = `Show ${Math.min(rest, STEP)} more of ${rest}`;
      if (focus && next.length) next[0].querySelector("summary").focus();
    }

    row(index) {
      const [id, command, group, , answers] = this.data.samples[index];
      const badges = answers.map((answer, system) => (answer && (this.system.value === "" || Number(this.system.value) === system) ? this.badge(answer[0], system) : null));
      const summary = element("summary", {}, element("span", {}, element("span", { class: "id" }, group ? `${id} · ${group}` : id),
        element("span", { class: "command" }, command || "(command not shown: the test data is not there)")), element("span", { class: "badges" }, badges));
      const details = element("details", { id: `sample-${this.number}-${index}` }, summary);
      details.addEventListener("toggle", () => this.open(details, index));
      return element("li", {}, details);
    }

    badge(outcome, system) {
      const right = outcome === 0;
      const name = this.data.systems.length > 1 ? `${this.data.systems[system]}: ` : "";
      return element("span", { class: right ? "badge right" : "badge" }, `${right ? "✓" : "✗"} ${name}${this.data.outcomes[outcome]}`);
    }

    async open(details, index) {
      if (!details.open || details.querySelector(".body")) return;
      const body = element("div", { class: "body" });
      details.append(body);
      const [expected, answers, given] = await this.details(index);
      if (given.task) body.append(element("p", { class: "facts" }, `Task ${given.task} with `, this.values(given.parameters ?? {}, [])));
      // Systems with the same answer share a comparison.
      const groups = new Map();
      answers.forEach((answer, system) => {
        const brief = this.data.samples[index][4][system];
        if (!(answer || brief) || !(this.system.value === "" || Number(this.system.value) === system)) return;
        const key = JSON.stringify([answer && answer.slice(0, 3), brief && brief[0]]);
        groups.set(key, [...(groups.get(key) ?? []), system]);
      });
      for (const alike of groups.values()) body.append(this.answer(expected, answers[alike[0]], this.data.samples[index][4][alike[0]], alike));
    }

    details(index) {
      const part = Math.floor(index / this.data.part);
      if (!this.parts.has(part)) this.parts.set(part, unpack(document.getElementById(`part-${this.number}-${part}`).textContent));
      return this.parts.get(part).then((rows) => rows[index % this.data.part]);
    }

    answer(expected, answer, brief, alike) {
      const outcome = brief ? `${this.data.outcomes[brief[0]]}${brief[1] === null ? "" : `, F1 ${brief[1].toFixed(2)}`}` : "not scored";
      const names = alike.map((system) => this.data.systems[system]).join(" · ");
      const parts = [element("h4", {}, `${names}: ${outcome}`)];
      if (!answer) return element("section", {}, parts, element("p", { class: "facts" }, "The answer is not there."));
      const [predicted, lines, problem, raw] = answer;
      if (problem) parts.push(element("p", { class: "facts" }, `The answer does not parse: ${problem}.`));
      if (!expected.length && !predicted.length && !problem) parts.push(element("p", { class: "facts" }, "No tasks are expected, and none are planned."));
      const rows = lines.length ? lines : predicted.map((_entry, place) => ["same", null, place, []]);
      if (rows.length) parts.push(this.plans(expected, predicted, rows, lines.length > 0, names));
      parts.push(element("details", {}, element("summary", {}, "Answer as written"), element("pre", {}, raw)));
      return element("section", {}, parts);
    }

    plans(expected, predicted, rows, compared, names) {
      const head = element("tr", {}, element("th", { class: "what", scope: "col" }, "Difference"), element("th", { scope: "col" }, "Expected"), element("th", { scope: "col" }, "Predicted"));
      const body = rows.map(([mark, ours, theirs, changed]) => element("tr", { class: compared ? mark : "" },
        element("th", { class: "what", scope: "row" }, compared ? WORDS[mark] : "–"),
        this.entry("Expected", expected[ours], changed), this.entry("Predicted", predicted[theirs], changed)));
      return element("table", { class: "plans" }, element("caption", { class: "unseen" }, `Expected plan and answer of ${names}`), element("thead", {}, head), element("tbody", {}, body));
    }

    entry(label, entry, changed) {
      if (!entry) return element("td", { "data-label": label, class: "absent" }, "–");
      const [name, parameters, place, text] = entry;
      return element("td", { "data-label": label }, element("span", { class: "place" }, place), element("span", { class: "name" }, name), this.values(parameters, changed),
        text ? element("span", { class: "prompt" }, text) : null);
    }

    values(parameters, changed) {
      const shown = Object.entries(parameters).map(([key, value]) => {
        const text = `${key}=${JSON.stringify(value)}`;
        return element("span", {}, changed.includes(key) ? element("mark", {}, text) : text);
      });
      return element("span", { class: "values" }, shown);
    }

    step(event) {
      if (event.target.tagName !== "SUMMARY" || (event.key !== "ArrowDown" && event.key !== "ArrowUp")) return;
      const all = [...this.list.querySelectorAll(":scope > li > details > summary")];
      const next = all[all.indexOf(event.target) + (event.key === "ArrowDown" ? 1 : -1)];
      if (next) { event.preventDefault(); next.focus(); }
    }

    // A link to one sample: #sample-TESTSET-PLACE.
    follow() {
      const [, number, index] = location.hash.match(/^#sample-(\d+)-(\d+)$/) ?? [];
      if (number !== this.number || !this.data.samples[index]) return;
      this.set();
      while (this.shown <= index) this.extend(false);
      const details = document.getElementById(`sample-${number}-${index}`);
      details.open = true;
      details.querySelector("summary").focus();
      details.scrollIntoView();
    }

    // Counts of failures become buttons that show these samples.
    link(figure) {
      const kinds = [...figure.querySelectorAll("thead th")].slice(1).map((cell) => cell.textContent);
      for (const row of figure.querySelectorAll("tbody tr")) {
        const name = row.querySelector("th").textContent;
        const system = this.data.systems.indexOf(name);
        if (system < 0) continue;
        [...row.querySelectorAll("td")].forEach((cell, index) => {
          const count = cell.textContent;
          if (!Number(count) || !this.data.outcomes.includes(kinds[index])) return;
          const show = () => { this.set({ system: String(system), outcome: `kind ${kinds[index]}` }); this.status.scrollIntoView(); this.list.querySelector("summary")?.focus(); };
          cell.replaceChildren(element("button", { type: "button", "aria-label": `${count}: show samples of ${name} with ${kinds[index]}`, on: { click: show } }, count));
        });
      }
    }
  }

  for (const root of document.querySelectorAll(".explorer")) {
    const explorer = new Explorer(root);
    root.closest("section").querySelectorAll('figure[id$="-failures"]').forEach((figure) => explorer.link(figure));
  }
})();
