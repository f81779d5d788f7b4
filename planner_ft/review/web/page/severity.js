// The three severities of warnings: what each is called, and the way to a warning.

/** Severity, and what one of it is called; the gravest first. */
export const SEVERITIES = [["danger", "danger"], ["caution", "caution"], ["note", "note"]];

export const SIGNS = { danger: "▲", caution: "△", note: "ⓘ" };

export const of = (store, severity) => store.warnings.filter((warning) => warning.severity === severity);

/** Brings a warning (by its id), or the panel of warnings, into view and gives it the focus. */
export function reveal(event, id) {
  event?.preventDefault();
  const goal = document.querySelector(`[data-warning="${CSS.escape(id)}"] input`) || document.getElementById(id);
  goal?.focus({ preventScroll: true });
  goal?.closest("li, section").scrollIntoView({ block: "center" });
}
