// Requests to the program that serves this page. Every answer is JSON; a refusal is one sentence.

export class Refused extends Error {
  constructor(status, body) {
    super(body.error || `The program answered with status ${status}; look at the terminal that it runs in.`);
    this.status = status;
    this.body = body;
  }
}

async function request(path, options) {
  let answer;
  try {
    answer = await fetch(path, { credentials: "same-origin", cache: "no-store", ...options });
  } catch {
    throw new Refused(0, { error: "The program does not answer, so nothing was saved; check that plannerft review still runs, then try again." });
  }
  const body = await answer.json().catch(() => ({}));
  if (!answer.ok) throw new Refused(answer.status, body);
  return body;
}

export const get = (path) => request(path);

export const post = (path, body) => request(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });

/** Server-sent events: `handlers` by name, each with the event's object; `connected` is told when the stream comes and goes. */
export function listen(handlers, connected) {
  const source = new EventSource("/api/events");
  source.addEventListener("open", () => connected(true));
  for (const [name, handle] of Object.entries(handlers)) {
    source.addEventListener(name, (event) => {
      // A lost connection is an event called "error" as well; it carries no data.
      if (event.data === undefined) connected(false);
      else handle(JSON.parse(event.data));
    });
  }
  return () => source.close();
}
