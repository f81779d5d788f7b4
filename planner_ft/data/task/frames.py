"""Words around a prompt that change nothing of its plan: openers, asides, refusals."""

from __future__ import annotations

from planner_ft.data.numbers import pick
from planner_ft.data.task.clauses import WORDS
from planner_ft.data.task.context import Context


def opened(text: str, c: Context) -> str:
    """The prompt with a full stop, now and then behind polite words or the task's opener."""
    text = text if text[-1:] in ".!?" else f"{text}."
    command = text.partition(" ")[0].lower() in c.book.verbs
    if c.book.unseen or not command or c.rng.random() < 0.85:
        return text
    own = c.entry.openers if c.rng.random() < 0.7 else []
    opener = pick(own or WORDS["openers"], c.rng)
    return f"{opener[0].upper()}{opener[1:]} {text[0].lower()}{text[1:]}"


def aside(text: str, skills: set[str], c: Context) -> str:
    """The prompt, now and then with words that change nothing: background, a reason, a refusal."""
    book, rng, known, roll = c.book, c.rng, c.book.sentences, c.rng.random()
    if roll < 0.03 and "background" in known:
        remark = c.say(pick(known["background"], rng))
        return pick((f"{text} {remark}", f"{remark} {text}"), rng)
    if roll < 0.05 and "reason" in known:
        return f"{text[:-1]} {c.say(pick(known['reason'], rng))}."
    if roll < 0.075 and "nothing" in known and not book.unseen:
        return f"{text} {pick(known['nothing'], rng)}"
    if roll < 0.115 and not book.unseen:
        refused = [entry.none for name, entry in book.skills.items() if name not in skills]
        if phrases := [phrase for of_skill in refused for phrase in of_skill]:
            phrase = pick(phrases, rng)
            return pick(
                (f"{text} {phrase[0].upper()}{phrase[1:]}.", f"{text[:-1]}, {phrase}."), rng
            )
    elif roll < 0.14 and "negation" in known:
        idle = [name for name in c.task.skills.get("perception", ()) if name not in skills]
        if bare := [found for name in idle if (found := book.skills[name].bare)]:
            return (
                f"{text} {pick(known['negation'], rng).format(c.say(pick(pick(bare, rng), rng)))}"
            )
    return text
