"""What the command asks for and no task does, and tasks and data that it does not want."""

import re
from collections.abc import Iterator, Mapping

from planner_ft.document.language import Ask, Clause
from planner_ft.document.track import place_of
from planner_ft.document.warnings.case import Case, Warning, quoted, skills_of, warning
from planner_ft.facts import corrections, unknown_words
from planner_ft.facts.numbers import read_numbers
from planner_ft.support.files import compact_json

STEM = 5  # first letters by which a word is found again
NEAR = 24  # characters in which words that rule something out stand before it
BESIDE = 12  # characters between words that rule something out and those that name it
ARTICLE = 3  # words before a noun among which its article is
NONE = re.compile(r"No |(The [\w ]+? does not )")
"""How a constraint begins that leaves something out, or something that the vehicle does."""
IT = re.compile(r"\s+(?:all )?(?:it|that|this|them|those|these)\W*", re.IGNORECASE)
BEGUN = re.compile(r"[.!?;]\s+(?:(?:no|oh|er|um|wait|sorry|actually)\W*)*$", re.IGNORECASE)
SENTENCE = re.compile(r"(?<!\.)[.!?;]\s")  # no dots of hesitation
# The share of unknown words of another language (benchmarks/language_check.py).
PASSING = ("goes", "over", "than", "more", "less", "down", "drops", "below", "above", "under")
"""Words of a condition that do not say what it is about."""
UNKNOWN = 0.55
FEWEST_UNKNOWN = 3  # words of a clause


def other_language(command: str) -> str | None:
    """A sentence on a command that is not English, as far as can be told from its words."""
    unknown, share = unknown_words(command)
    if share < UNKNOWN:
        return None
    listed = ", ".join(f'"{word}"' for word in unknown[:3])
    text = f"Most words of the command are not known ({listed}): it is not English, or is"
    return f"{text} misspelt, and the plan is what could be read."


def other_words(case: Case) -> Iterator[Warning]:
    """A command that is hardly understood, or a clause of it."""
    if text := other_language(case.command):
        yield warning("unknown-language", words=text)
        return
    for clause in case.typed:
        unknown, share = unknown_words(clause.text)
        # A name has a capital, and a slip is near a known word.
        plain = [word for word in unknown if word in clause.text]
        slips = all(map(corrections, plain))
        if len(plain) >= FEWEST_UNKNOWN and share >= UNKNOWN and not slips:
            words = quoted(clause.text.strip(" ,;."))
            yield warning("unknown-language", "clause", about=words.casefold(), words=words)


# ---------------------------------------------------------------- words of the ontology


def not_planned(case: Case) -> Iterator[Warning]:
    """Words that ask for a task that the plan neither has nor declines."""
    declines = case.words["declined"].search
    declined = " ".join(text for text in case.texts if declines(text)).casefold()
    gone = _taken_back(case)
    for clause in case.typed:
        for words, start in _unanswered(clause, case, gone):
            if words.casefold() not in declined:
                asked = quoted(clause.text[start:])
                yield warning("not-planned", words=asked, about=words.casefold())


def left_out(case: Case) -> Iterator[Warning]:
    """What the plan itself says that the vehicle has no task for. A plan without tasks says why."""
    for line in case.document.get("constraints", ()) if case.tasks else ():
        if case.words["unable"].match(line):
            yield warning("left-out", words=line.rstrip("."), about=line.casefold())


def _unanswered(clause: Clause, case: Case, gone: Mapping[Ask, str]) -> Iterator[tuple[str, int]]:
    """(words, where in the clause) that ask for an unplanned task, or one that is impossible."""
    if clause.corrected:
        return
    planned, sending = {task["title"] for task in case.tasks}, sends(clause, case)
    for ask in (one for one in case.spoken.asks if one not in gone):
        match = ask.said.search(clause.text)
        if match and any(case.vocabulary.task[title].docks for title in ask.tasks):
            # A word behind an article and two other words at most is a noun: "the dry dock".
            before = clause.text[: match.start()].split()[-ARTICLE:]
            is_noun = any(map(case.words["determiner"].fullmatch, before))
            match = None if is_noun else match
        # Data to be sent is named by how it came about, which may be long ago: "send the panorama".
        missing = not _sent_by(ask, clause, case) & planned and (ask.sends or not sending)
        if match and missing and clause.wants(clause.start + match.start()):
            yield match[0], match.start()
    first = clause.text.lstrip()
    impossible = case.words["impossible"].match(first)
    # "Take the samples to ward 3" asks for a task of its own with some vehicles.
    own = any(ask.said.match(first) and ask.tasks & planned for ask in case.spoken.asks)
    # A plan without tasks says itself why.
    if planned and impossible and not own and clause.wants(clause.start):
        yield impossible[0], 0


def ruled_out_still(case: Case) -> Iterator[Warning]:
    """A task that the command takes back at last, and that the plan has."""
    said = [ask for ask in case.spoken.asks for _ in ask.said.finditer(case.command)]
    as_it = dict(_taken_back_as_it(case))
    for ask, words in _taken_back(case).items():
        own = [task for task in case.tasks if task["title"] in ask.tasks]
        # "Survey the wreck ... scratch that": of several tasks, where none of them is asked again.
        often = [one for one in said if one.tasks & ask.tasks]
        if (len(ask.tasks) == 1 or (ask in as_it and often == [ask])) and len(own) == 1:
            yield warning("contradiction", "ruled_out", own[0], about=words.casefold(), words=words)


def against_itself(case: Case) -> Iterator[Warning]:
    """A task of the plan that a constraint of the plan rules out: "Diagnostics are not run", "The
    vehicle does not dock".
    """
    for text in case.document.get("constraints", ()):
        begun = NONE.match(text)
        behind = text[begun.end() if begun else 0 :].rstrip(" .")
        for ask in case.spoken.asks:
            match = ask.named.match(behind)
            whole = match is not None and match.end() == len(behind)
            certain = whole if begun and begun[1] else len(ask.tasks) == 1
            ruled_out = begun or case.words["exclusion"].search(text)
            own = [task for task in case.tasks if task["title"] in ask.tasks]
            if match and certain and ruled_out and own:
                words = {"limit": text.rstrip("."), "about": text.casefold()}
                yield warning("contradiction", "itself", own[0], **words)
                break


def _taken_back(case: Case) -> dict[Ask, str]:
    """Tasks with the words that rule them out, where nothing behind them asks for one again. An ask
    without nouns is of several things: what rules one of them out leaves the others.
    """
    last = dict[Ask, str]()
    for ask in (one for one in case.spoken.asks if one.named.pattern != one.said.pattern):
        for clause in (one for one in case.typed if not one.corrected):
            for match in ask.named.finditer(clause.text):
                before = clause.text[max(0, match.start() - NEAR) : match.start()]
                # "The report" behind "forget the diagnostics and" has no word that rules it out.
                no = case.words["exclusion"].search(clause.text)
                ruled_out = no is None and clause.excluded == clause.start
                ruled_out |= case.words["exclusion"].search(before) is not None
                last.pop(ask, None)
                if ruled_out and clause.excluded is not None and clause.excluded >= clause.start:
                    last[ask] = quoted(clause.text.strip(" ,;"))
    return {**last, **dict(_taken_back_as_it(case))}


def _taken_back_as_it(case: Case) -> Iterator[tuple[Ask, str]]:
    """The last task of a sentence that "skip it" rules out."""
    said = sorted(
        (match.start(), at)
        for at, ask in enumerate(case.spoken.asks)
        for match in ask.said.finditer(case.command)
    )
    for clause in case.typed:
        ruled_out = case.words["exclusion"].search(clause.text)
        # "For an hour, no, scratch that, forty minutes" takes the value back.
        behind = read_numbers(case.command[clause.end : clause.end + NEAR].lstrip(" ,"))
        valued = any(number.start == 0 for number in behind)
        if ruled_out and IT.fullmatch(clause.text, ruled_out.end()) and not valued:
            before = [(start, at) for start, at in said if start < clause.start]
            between = case.command[before[-1][0] : clause.start] if before else ""
            # "Take a panorama. No, forget that": the words begin the next sentence.
            if before and not SENTENCE.search(BEGUN.sub("", between)):
                yield case.spoken.asks[before[-1][1]], quoted(clause.text.strip(" ,;"))


def without_words(case: Case) -> Iterator[Warning]:
    """Tasks that nobody asks for without words for them, of which the command has none."""
    if unknown_words(case.command)[1] >= UNKNOWN:
        return
    told = " ".join(case.command.split())
    for ask in (one for one in case.spoken.asks if one.sure and not one.sure.search(told)):
        for task in (one for one in case.tasks if one["title"] in ask.tasks):
            yield warning("value-not-said", "asked", task, about="asked")


def _sent_by(ask: Ask, clause: Clause, case: Case) -> frozenset[str]:
    """The tasks that do what is asked for. A report does not send data: "upload the stills"."""
    others = [one for one in case.spoken.asks if one.sends and one.tasks < ask.tasks]
    if not ask.sends or not any(clause.spans(case.spoken.sensors)):
        return ask.tasks
    unnamed = (one.tasks for one in others if not one.named.search(clause.text))
    return ask.tasks.difference(*unnamed)


def sends(clause: Clause, case: Case) -> bool:
    """Whether a clause asks for something to be sent."""
    return any(ask.sends and ask.said.search(clause.text) for ask in case.spoken.asks)


# ---------------------------------------------------------------- instructions in other words


def instructions(case: Case) -> Iterator[Warning]:
    """Instructions beyond the plan's tasks of which no word and no fact is in the plan."""
    told = [clause for clause in case.clauses if _instructs(clause, case)]
    if len(told) <= _own_tasks(case):
        return
    owners = [*case.tasks, *(skill for task in case.tasks for _role, skill in skills_of(task))]
    parts = [[*case.texts, *(task["task_prompt"] for task in case.tasks)]]
    parts += [list(owner["parameters"].values()) for owner in owners]
    planned = compact_json(parts).casefold()
    known = [case.words[name] for name in ("impossible", "home", "here", "stay")]
    known += [case.spoken.sensors, *(ask.said for ask in case.spoken.asks)]
    known += [data.said for data in case.spoken.data if data.ruled_out]
    senses = [case.words[name] for name in ("clockwise", "anticlockwise")]
    if any(one.search(task["task_prompt"]) for task in case.tasks for one in senses):
        known.append(case.words["beam"])  # "keep it to port" is the sense of a round
    empty = [case.words[name] for name in ("nothing", "water", "boundary", "determiner")]
    for clause in told:
        text = clause.text.strip()
        verb = case.words["verb"].match(text)
        if not verb or read_numbers(text) or any(words.search(text) for words in known):
            continue
        said = re.findall(r"[a-z]{4,}", text[verb.end() :].casefold())
        nouns = [word for word in said if not any(one.fullmatch(word) for one in empty)]
        if nouns and not any(word[:STEM] in planned for word in said):
            yield warning("not-planned", words=quoted(text), about=text.casefold())


def _instructs(clause: Clause, case: Case) -> bool:
    """Whether a clause begins with an instruction that stands, other than to come home."""
    begins = case.words["verb"].match(clause.text.strip())
    stands = begins is not None and not clause.corrected and clause.excluded is None
    return stands and not case.words["home"].search(clause.text)


def _own_tasks(case: Case) -> int:
    """The tasks that such an instruction stands for: not those that look for a place, go to one for
    the task behind them, or go home.
    """
    known = case.vocabulary
    behind = [known.task[task["title"]].arrival for task in case.tasks[1:]] + ["none"]
    return sum(
        task["title"] != known.locate
        and place_of(task, known) != known.home
        and not (task["title"] == known.transit and arrival == "transit")
        for task, arrival in zip(case.tasks, behind, strict=True)
    )


def conditions(case: Case) -> Iterator[Warning]:
    """Clauses that make an order depend on something of which the plan's texts have no word."""
    texts = " ".join([*case.texts, *(task["task_prompt"] for task in case.tasks)]).casefold()
    for clause in (one for one in case.clauses if not one.corrected):
        match = case.words["condition"].search(clause.text)
        if match is None or case.words["supposed"].search(clause.text):
            continue
        behind = clause.text[match.end() :].strip(" ,;.")
        # "weather permitting" has its words before.
        text = clause.text[match.start() :] if behind else clause.text
        said = re.findall(r"[a-z]{4,}", (behind or clause.text[: match.start()]).casefold())
        # What the command also says elsewhere, "the wind turbine", tells nothing of "if the wind".
        others = case.command.replace(text, " ").casefold()
        own = [word for word in said if word[:STEM] not in others]
        own = [word for word in own if word not in PASSING] or own or said
        if own and not any(word[:STEM] in texts for word in own):
            words = quoted(text.strip(" ,;."))
            yield warning("condition-lost", words=words, about=words.casefold())


def home_and_not(case: Case) -> Iterator[Warning]:
    """A command that asks for home and rules it out, or rules it out for a plan that ends there."""
    said = [
        (clause.wants(clause.start + match.start()), clause, clause.start + match.start())
        for clause in case.clauses
        if not clause.corrected
        for match in case.words["home"].finditer(clause.text)
        if match.end() not in {at.end() for at in case.words["from_home"].finditer(clause.text)}
    ]
    wishes = {wanted for wanted, _clause, _at in said}
    there = place_of(case.tasks[-1], case.vocabulary) == case.vocabulary.home
    # "No return", but not "don't touch the net and go home".
    none = wishes == {False} and all(
        one.excluded is not None and 0 <= at - one.excluded <= BESIDE for _no, one, at in said
    )
    if wishes == {True, False} or (none and there):
        words = quoted(next(clause.text for wanted, clause, _at in said if not wanted).strip(" ,;"))
        ends = "ends there" if there else "does not end there"
        yield warning("contradiction", "home", about="home", words=words, ends=ends)
