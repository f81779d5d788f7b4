// What the page knows, and everything that it can ask the program to do. Components call a method, the store changes and the page is drawn anew.

import { Refused, get, listen, post } from "./api.js";
import { same } from "./format.js";
import { watched } from "./run.js";

const NAMELESS = "Nothing was changed: a change needs the name of who makes it.";
const NOTHING_PLANNED = { tasks: null, skills: {} };

export class Store {
  constructor(draw) {
    this.draw = draw;
    this.plan = null; // the answer of /api/state
    this.selected = null; // {task, parameter?, step?}: what list, chart and command show together
    this.opened = {}; // task id -> whether its details are shown
    this.reviewer = sessionStorage.getItem("reviewer") || ""; // whose changes and decisions are made here
    this.naming = null; // {take}: asks for that name before a change
    this.lit = []; // spans of the command that are highlighted
    this.acknowledged = {}; // warning id -> the text that was acknowledged: a warning whose text changes counts as new
    this.conflict = null; // {error, label, repeat}: an own change that met somebody else's
    this.alert = null; // a sentence about something that failed
    this.notice = ""; // a sentence about something that happened, for screen readers too
    this.draft = NOTHING_PLANNED; // what the agents have answered so far while they plan
    this.connected = true;
    this.placing = null; // the name of the place that is being put on the chart
    this.watch = null; // the run that is shown: {frames, at (null: the last frame), folder}
    this.sent = 0;
    this.shown = 0;
    this.changing = 0; // own changes that are not answered yet
  }

  set(values) {
    Object.assign(this, values);
    this.draw();
  }

  start() {
    this.refresh();
    return listen(
      {
        progress: (busy) => this.plan && this.set({ plan: { ...this.plan, busy } }),
        tasks: ({ tasks }) => this.set({ draft: { tasks, skills: {} }, notice: `The Mission Agent answered: ${tasks.length} tasks.` }),
        skills: ({ task, skill_sequence }) => this.set({ draft: { ...this.draft, skills: { ...this.draft.skills, [task]: skill_sequence || [] } } }),
        run: (frame) => watched(this, frame),
        state: () => this.refresh(),
        error: ({ error }) => this.set({ alert: error, draft: NOTHING_PLANNED }) || this.refresh(),
      },
      (connected) => {
        const back = connected && !this.connected;
        this.set({ connected });
        if (back) this.refresh();
      },
    );
  }

  async refresh() {
    const asked = ++this.sent;
    try {
      this.receive(await get("/api/state"), asked, "elsewhere");
    } catch (error) {
      this.set({ alert: error.message });
    }
  }

  /** Takes a state over, unless a younger one is shown already. `source` is "own" for the answer to an own change. */
  receive(plan, asked, source) {
    if (asked < this.shown) return;
    this.shown = asked;
    const before = this.plan;
    const other = before && (before.path !== plan.path || before.document?.command !== plan.document?.command);
    const values = { plan };
    if (!before && plan.reviewer && !this.reviewer) values.reviewer = plan.reviewer;
    if (other) Object.assign(values, { selected: null, opened: {}, lit: [], acknowledged: {}, placing: null, notice: `Shown now: ${plan.path}.` });
    else if (source === "elsewhere" && before && before.revision !== plan.revision && !this.changing) values.notice = "The plan was changed elsewhere; it is shown as it is now.";
    if (!plan.busy) values.draft = NOTHING_PLANNED;
    if (this.placing && !openNames(plan).includes(this.placing)) values.placing = null;
    if (this.selected && !plan.document?.tasks.some((task) => task.id === this.selected.task)) values.selected = null;
    this.set(values);
  }

  /** Asks for a change of the plan shown. Returns null, or the sentence that says why it was refused. `label` names the change where it must be made again. */
  async change(path, body, label, { repeat = true, done = "" } = {}) {
    const asked = ++this.sent;
    this.set({ changing: this.changing + 1, alert: null });
    try {
      const answer = await post(path, { revision: this.plan.revision, ...body });
      if (answer.document !== undefined) this.receive(answer, asked, "own");
      this.set({ conflict: null, notice: done });
      return null;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      if (error.status !== 409 || !error.body.state) return error.message;
      this.receive(error.body.state, asked, "own");
      this.set({ conflict: { error: error.message, label, repeat: repeat ? () => this.change(path, body, label, { repeat, done }) : null } });
      return error.message;
    } finally {
      this.set({ changing: this.changing - 1 });
    }
  }

  /** As `change`, for what has no field to show a refusal at. */
  async act(...change) {
    const refused = await this.change(...change);
    if (refused && !this.conflict) this.set({ alert: refused });
    return refused;
  }

  /** Makes a change that met somebody else's on the plan as it is now. */
  async repeat(conflict) {
    this.set({ conflict: null });
    const refused = await conflict.repeat();
    if (refused && !this.conflict) this.set({ alert: refused });
  }

  /** Whose change it is; asked once. Null: nobody said. */
  async whose() {
    if (!this.reviewer.trim()) {
      const name = await new Promise((take) => this.set({ naming: { take } }));
      this.set({ naming: null });
      if (name) this.rename(name);
    }
    return this.reviewer.trim() || null;
  }

  rename(reviewer) {
    sessionStorage.setItem("reviewer", reviewer);
    this.set({ reviewer });
  }

  async edit(edit, label) {
    const by = await this.whose();
    if (!by) return NAMELESS;
    return this.change("/api/edit", { edit, by }, label, { done: `Saved: ${label}.` });
  }

  async editOrTell(edit, label) {
    const refused = await this.edit(edit, label);
    if (refused && !this.conflict) this.set({ alert: refused });
    return refused;
  }

  undo() {
    return this.act("/api/undo", {}, "undo", { repeat: false, done: "The last change was taken back." });
  }

  async skillsAgain(task, label) {
    const by = await this.whose();
    if (!by) return this.set({ alert: NAMELESS });
    return this.act("/api/skills", { task, by }, `new steps for ${label}`, { done: `The Task Agent plans ${label} again.` });
  }

  approve(name = this.reviewer.trim()) {
    const acknowledged = this.warnings.filter((warning) => this.isAcknowledged(warning)).map((warning) => warning.id);
    return this.change("/api/approve", { name, acknowledged }, "approval", { repeat: false, done: "The plan is approved." });
  }

  reject(name, reason) {
    return this.change("/api/reject", { name, reason }, "rejection", { repeat: false, done: "The plan is rejected." });
  }

  /** Has a command planned. Returns null, or what was refused: {error, question?}. */
  async command(text, sure) {
    this.set({ draft: NOTHING_PLANNED });
    return this.asked("/api/plan", { command: text, sure }, "The agents are planning.");
  }

  /** Writes the approved plan for vehicles: {files}, or {error, question?}. */
  async exportAs(formats, origin, overwrite, sure) {
    try {
      const files = await post("/api/export", { revision: this.plan.revision, formats, origin, overwrite, sure });
      this.set({ notice: `Written: ${files.map((one) => one.file).join(", ")}.` });
      return { files };
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      return { error: error.message, question: error.body.question };
    }
  }

  open(path) {
    return this.ask("/api/open", { path }, "").then((refused) => refused && this.set({ alert: refused }));
  }

  /** As `asked`; returns null, or the sentence that says why it was refused. */
  async ask(path, body, done) {
    return (await this.asked(path, body, done))?.error ?? null;
  }

  async asked(path, body, done) {
    const asked = ++this.sent;
    this.set({ alert: null }); // now: agents may fail before the answer comes
    try {
      const answer = await post(path, body);
      if (answer.document !== undefined) this.receive(answer, asked, "own");
      if (done) this.set({ notice: done });
      if (answer.document === undefined) this.refresh();
      return null;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      return { error: error.message, question: error.body.question };
    }
  }

  select(selected) {
    if (!same(selected, this.selected)) this.set({ selected });
  }

  light(lit) {
    if (!same(lit, this.lit)) this.set({ lit });
  }

  get warnings() {
    return this.plan?.warnings || [];
  }

  isAcknowledged(warning) {
    return this.acknowledged[warning.id] === warning.text;
  }

  acknowledge(warning, yes) {
    this.set({ acknowledged: { ...this.acknowledged, [warning.id]: yes ? warning.text : undefined } });
  }

  /** The task with an id, and its number from 1. */
  task(id) {
    const index = this.plan.document.tasks.findIndex((task) => task.id === id);
    return { task: this.plan.document.tasks[index], number: index + 1 };
  }
}

/** The names that can be placed: open ones, and those that have a place already. */
export function openNames(plan) {
  return plan.document ? [...plan.document.open_places.map((open) => open.name), ...Object.keys(plan.document.located)] : [];
}
